#include "parameters.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace rrcb::zoltan {

namespace {

template <typename Number>
bool read_number(std::string_view text, Number& number) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

/// In 1-D and 2-D; the balancer, which knows the dimension, takes fewer in 3-D.
constexpr int most_cells = 4096;

bool read_support_mesh(Options& options, std::string_view text) {
    int cells = 0;
    const bool automatic = text == "AUTO";
    if (!automatic && (!read_number(text, cells) || cells < 1 || cells > most_cells)) return false;
    options.support_mesh = cells;
    return true;
}

bool read_domain(Options& options, std::string_view text) {
    if (text == "ANALYTIC") {
        options.domain = DomainKind::analytic;
    } else if (text == "SAMPLED") {
        options.domain = DomainKind::sampled;
    } else if (text == "POINTS") {
        options.domain = DomainKind::points;
    } else {
        return false;
    }
    return true;
}

bool read_cut_rule(Options& options, std::string_view text) {
    if (text != "WEIGHTED" && text != "MIDPOINT") return false;
    options.cut_rule = text == "WEIGHTED" ? CutRule::weighted_fraction : CutRule::midpoint;
    return true;
}

bool read_refine(Options& options, std::string_view text) {
    constexpr std::pair<std::string_view, Refine> words[] = {{"AUTO", Refine::automatic},
                                                             {"NONE", Refine::none},
                                                             {"TOLERANCE", Refine::tolerance},
                                                             {"EXACT", Refine::exact}};
    const auto* word = std::ranges::find(words, text, &std::pair<std::string_view, Refine>::first);
    if (word == std::end(words)) return false;
    options.refine = word->second;
    return true;
}

bool read_sigma_multiplier(Options& options, std::string_view text) {
    double value = 0;
    if (!read_number(text, value) || !std::isfinite(value) || value <= 0) return false;
    options.sigma_multiplier = value;
    return true;
}

bool read_sample_fraction(Options& options, std::string_view text) {
    double value = 0;
    if (!read_number(text, value) || !(value > 0 && value <= 1)) return false;
    options.sample_fraction = value;
    return true;
}

bool read_seed(Options& options, std::string_view text) {
    return read_number(text, options.seed);
}

struct OwnParameter {
    std::string_view name;
    bool (*read)(Options&, std::string_view);
    void (*reset)(Options&);
};

template <auto field>
void reset(Options& options) {
    options.*field = Options{}.*field;
}

constexpr OwnParameter own_parameters[] = {
    {"RRCB_SUPPORT_MESH", read_support_mesh, reset<&Options::support_mesh>},
    {"RRCB_DOMAIN", read_domain, reset<&Options::domain>},
    {"RRCB_CUT_RULE", read_cut_rule, reset<&Options::cut_rule>},
    {"RRCB_REFINE", read_refine, reset<&Options::refine>},
    {"RRCB_SIGMA_MULTIPLIER", read_sigma_multiplier, reset<&Options::sigma_multiplier>},
    {"RRCB_SAMPLE_FRACTION", read_sample_fraction, reset<&Options::sample_fraction>},
    {"RRCB_SEED", read_seed, reset<&Options::seed>},
};

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
    {"DEBUG_LEVEL", &Parameters::debug_level, 0},
};

int integer_or(std::string_view text, int minimum, int fallback) {
    if (text.starts_with('T')) return 1;
    if (text.starts_with('F')) return 0;
    const int value = std::atoi(std::string(text).c_str());
    return text == "DEFAULT" || value < minimum ? fallback : value;
}

/// Zoltan allows one tolerance per weight, as "[k]" behind the name; RRCB balances one weight.
void note_tolerance(Options& options, std::string_view text) {
    double value = 0;
    options.imbalance_tolerance = read_number(text, value) && std::isfinite(value) && value >= 1
                                      ? value
                                      : Options{}.imbalance_tolerance;
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

Setting set_own(Parameters& parameters, std::string_view name, std::string_view value) {
    const auto* own = std::ranges::find(own_parameters, name, &OwnParameter::name);
    if (own == std::end(own_parameters)) return Setting::unknown;
    if (value != "DEFAULT" && own->read(parameters.options, value)) return Setting::accepted;
    own->reset(parameters.options);
    return value == "DEFAULT" ? Setting::accepted : Setting::defaulted;
}

void note_common(Parameters& parameters, std::string_view name, std::string_view value) {
    if (name == "LB_METHOD") parameters.rrcb = false;
    if (name == "IMBALANCE_TOL") note_tolerance(parameters.options, value);
    if (name == "RETURN_LISTS") parameters.return_lists = return_lists(value);
    const auto* common = std::ranges::find(common_integers, name, &CommonInteger::name);
    if (common == std::end(common_integers)) return;
    const int fallback = Parameters{}.*common->field;
    parameters.*common->field = integer_or(value, common->minimum, fallback);
}

std::string clean(const char* text) {
    while (std::isspace(static_cast<unsigned char>(*text)) != 0) ++text;
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

}  // namespace rrcb::zoltan
