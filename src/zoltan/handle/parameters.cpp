#include "zoltan/handle/parameters.hpp"

#include "options/option_table.hpp"

#include <rrcb/points.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace rrcb::zoltan {

namespace {

constexpr std::string_view tolerance_name = "IMBALANCE_TOL";

/// Name of the one parameter whose value keeps its case.
constexpr std::string_view dump_folder_name = "RRCB_DUMP";

bool read_folder(std::string& folder, std::string_view text) {
    folder = text;
    return true;
}

bool read_dump_when(bool& always, std::string_view text) {
    if (text != "FAILURE" && text != "ALWAYS") return false;
    always = text == "ALWAYS";
    return true;
}

bool read_imbalance(double& imbalance, std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return false;
    if (value != 0 && !(value >= 1 && std::isfinite(value))) return false;
    imbalance = value;
    return true;
}

/// Parameter that only the plug-in has: name, reader, and setter of the default.
struct OwnParameter {
    std::string_view name;
    bool (*read)(Parameters&, std::string_view);
    void (*reset)(Parameters&);
};

template <auto field, auto read>
constexpr OwnParameter of_plug_in(std::string_view name) {
    return {name, [](Parameters& p, std::string_view text) { return read(p.*field, text); },
            [](Parameters& p) { p.*field = Parameters{}.*field; }};
}

constexpr OwnParameter own_parameters[] = {
    of_plug_in<&Parameters::skip_within, read_imbalance>("RRCB_SKIP_WITHIN"),
    of_plug_in<&Parameters::dump_folder, read_folder>(dump_folder_name),
    of_plug_in<&Parameters::dump_always, read_dump_when>("RRCB_DUMP_WHEN"),
};

bool is_own(const Option& option) {
    return std::string_view(option.parameter).starts_with("RRCB_");
}

struct CommonInteger {
    std::string_view name;
    int Parameters::*field;
    int minimum;  ///< below it Zoltan falls back to the default
};

constexpr int any_integer = std::numeric_limits<int>::min();

constexpr CommonInteger common_integers[] = {
    {"NUM_GID_ENTRIES", &Parameters::num_gid_entries, 1},
    {"NUM_LID_ENTRIES", &Parameters::num_lid_entries, 0},
    {"OBJ_WEIGHT_DIM", &Parameters::weight_dimension, 0},
    {"NUM_GLOBAL_PARTS", &Parameters::num_global_parts, 1},
    {"NUM_GLOBAL_PARTITIONS", &Parameters::num_global_parts, 1},
    {"NUM_LOCAL_PARTS", &Parameters::num_local_parts, 0},
    {"NUM_LOCAL_PARTITIONS", &Parameters::num_local_parts, 0},
    {"KEEP_CUTS", &Parameters::keep_cuts, any_integer},
    {"AUTO_MIGRATE", &Parameters::auto_migrate, any_integer},
    {"REMAP", &Parameters::remap, any_integer},
    {"RCB_REUSE", &Parameters::reuse_cuts, any_integer},
    {"RCB_LOCK_DIRECTIONS", &Parameters::lock_directions, any_integer},
    {"RCB_SET_DIRECTIONS", &Parameters::set_directions, any_integer},
    {"AVERAGE_CUTS", &Parameters::average_cuts, any_integer},
    {"RCB_RECTILINEAR_BLOCKS", &Parameters::rectilinear_blocks, any_integer},
    {"OBJ_WEIGHTS_COMPARABLE", &Parameters::weights_comparable, any_integer},
    {"RCB_MULTICRITERIA_NORM", &Parameters::multicriteria_norm, any_integer},
    {"REDUCE_DIMENSIONS", &Parameters::reduce_dimensions, any_integer},
    {"RCB_OUTPUT_LEVEL", &Parameters::output_level, any_integer},
    {"FINAL_OUTPUT", &Parameters::final_output, any_integer},
    {"DEBUG_LEVEL", &Parameters::debug_level, 0},
};

/// Value that Zoltan takes for DEFAULT and illegal values: that of a new handle, but in two cases.
int fallback_of(int Parameters::*field) {
    if (field == &Parameters::num_global_parts) return one_per_rank;
    if (field == &Parameters::remap) return 0;
    return Parameters{}.*field;
}

int integer_or(std::string_view text, int minimum, int fallback) {
    if (text.starts_with('T')) return 1;
    if (text.starts_with('F')) return 0;
    const int value = std::atoi(std::string(text).c_str());
    return text == "DEFAULT" || value < minimum ? fallback : value;
}

/// Notes a tolerance whose text Zoltan has accepted, of which it reads a number at the start.
///
/// Zoltan allows one tolerance per weight, as "[k]" behind the name. RRCB balances one weight.
void note_tolerance(Options& options, std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    const Option& tolerance = *find_parameter(tolerance_name);
    Options read;
    read.imbalance_tolerance = value;
    const bool legal = std::isfinite(value) && is_legal(tolerance, read, max_dimension);
    options.imbalance_tolerance = legal ? value : Options{}.imbalance_tolerance;
}

/// A number as Zoltan reads it: what stands behind it is ignored.
double number_or(std::string_view text, double fallback) {
    return text == "DEFAULT" ? fallback : std::atof(std::string(text).c_str());
}

ReturnLists return_lists(std::string_view text) {
    const auto has = [text](std::string_view word) { return text.find(word) != text.npos; };
    if (has("EXPORT")) return has("IMPORT") ? ReturnLists::all : ReturnLists::exports;
    if (has("IMPORT")) return ReturnLists::imports;
    if (has("CANDIDATE")) return ReturnLists::candidates;
    if (has("PART")) return ReturnLists::parts;
    return text == "NONE" ? ReturnLists::none : ReturnLists::all;
}

}  // namespace

Options default_options() {
    Options options;
    options.coincident = Coincident::divide;  // as RCB
    return options;
}

Setting set_own(Parameters& parameters, std::string_view name, const char* value) {
    const Option* option = find_parameter(name);
    const auto* own = std::ranges::find(own_parameters, name, &OwnParameter::name);
    const bool of_balancer = option != nullptr && is_own(*option);
    if (!of_balancer && own == std::end(own_parameters)) return Setting::unknown;
    const std::string cleaned = clean(value);
    const std::string_view upper = without_trailing_blanks(cleaned);
    const bool is_default = upper == "DEFAULT";
    const bool keeps_case = name == dump_folder_name;
    const bool is_read =
        !is_default && (of_balancer ? read_option(*option, upper, parameters.options)
                                    : own->read(parameters, keeps_case ? value : upper));
    if (is_read) return Setting::accepted;
    if (of_balancer) copy_option(*option, default_options(), parameters.options);
    if (!of_balancer) own->reset(parameters);
    return is_default ? Setting::accepted : Setting::defaulted;
}

bool set_tolerance(Parameters& parameters, std::string_view value) {
    return read_option(*find_parameter(tolerance_name), without_trailing_blanks(value),
                       parameters.options);
}

std::vector<const char*> own_parameter_names() {
    std::vector<const char*> names;
    for (const Option& option : option_table)
        if (is_own(option)) names.push_back(option.parameter);
    // Views of literals, so a null byte follows.
    for (const OwnParameter& own : own_parameters) names.push_back(own.name.data());
    return names;
}

void note_common(Parameters& parameters, std::string_view name, std::string_view value) {
    if (name == "LB_METHOD") parameters.rrcb = parameters.replace_rcb && value == "RCB";
    if (name == tolerance_name) note_tolerance(parameters.options, value);
    if (name == "DEGENERATE_RATIO")
        parameters.degenerate_ratio = number_or(value, Parameters{}.degenerate_ratio);
    if (name == "RCB_MAX_ASPECT_RATIO")
        parameters.max_aspect_ratio = number_or(value, Parameters{}.max_aspect_ratio);
    if (name == "RETURN_LISTS") parameters.return_lists = return_lists(value);
    const auto* common = std::ranges::find(common_integers, name, &CommonInteger::name);
    if (common == std::end(common_integers)) return;
    parameters.*common->field = integer_or(value, common->minimum, fallback_of(common->field));
}

std::string clean(const char* text) {
    while (std::isspace(static_cast<unsigned char>(*text)) != 0) ++text;
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

std::string_view without_trailing_blanks(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.remove_suffix(1);
    return text;
}

}  // namespace rrcb::zoltan
