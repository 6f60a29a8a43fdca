#include "zoltan/handle/parameters.hpp"

#include "arithmetic/non_stop.hpp"
#include "options/option_table.hpp"
#include "paper/paper_words.hpp"

#include <rrcb/points.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace rrcb::zoltan {

namespace {

constexpr std::string_view tolerance_name = "IMBALANCE_TOL";

bool is_own(std::string_view name) {
    return name.starts_with("RRCB_");
}

const ParameterRow* find_row(std::string_view name) {
    const auto* row = std::ranges::find(parameter_table, name, [](const ParameterRow& each) {
        return std::string_view(each.name);
    });
    return row == std::end(parameter_table) ? nullptr : row;
}

/// Notes a tolerance whose text Zoltan has accepted. As Zoltan does, reads the number at the
/// beginning of the text.
///
/// Zoltan has one tolerance for each weight, with "[k]" after the name. RRCB balances only one
/// weight.
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

}  // namespace

bool GivenParameters::note(const std::string& name, const std::string& value) {
    const std::string* previous = find(name);
    const bool is_changed = previous == nullptr || *previous != value;
    std::erase_if(entries, [&](const auto& entry) { return entry.first == name; });
    entries.emplace_back(name, value);
    return is_changed;
}

const std::string* GivenParameters::find(std::string_view name) const {
    for (const auto& [key, value] : entries)
        if (key == name) return &value;
    return nullptr;
}

bool reuses_cuts(const Parameters& parameters) {
    return parameters.reuse_cuts == not_set ? parameters.replace_rcb : parameters.reuse_cuts != 0;
}

int fallback_of(int Parameters::*field) {
    if (field == &Parameters::num_global_parts) return one_per_rank;
    if (field == &Parameters::remap) return 0;
    return Parameters{}.*field;
}

bool read_integer(int& value, std::string_view text, int least) {
    const bool is_word = text.starts_with('T') || text.starts_with('F');
    const int number = is_word ? int{text[0] == 'T'} : std::atoi(std::string(text).c_str());
    if (!is_word && number < least) return false;
    value = number;
    return true;
}

bool read_return_lists(ReturnLists& lists, std::string_view text) {
    const auto has = [text](std::string_view word) { return text.find(word) != text.npos; };
    lists = has("EXPORT")      ? has("IMPORT") ? ReturnLists::all : ReturnLists::exports
            : has("IMPORT")    ? ReturnLists::imports
            : has("CANDIDATE") ? ReturnLists::candidates
            : has("PART")      ? ReturnLists::parts
            : text == "NONE"   ? ReturnLists::none
                               : ReturnLists::all;
    return true;
}

bool read_folder(std::string& folder, std::string_view text) {
    folder = text;
    return true;
}

bool read_dump_when(bool& always, std::string_view text) {
    const auto* word = std::ranges::find(words_of_dump_when, text, &Word::word);
    if (word == std::end(words_of_dump_when)) return false;
    always = word->value != 0;
    return true;
}

Options default_options() {
    Options options;
    options.expert.coincident = Coincident::divide;  // as Zoltan's RCB does
    return options;
}

Setting set_own(Parameters& parameters, std::string_view name, const char* value) {
    if (!is_own(name)) return Setting::unknown;
    const NonStop arithmetic;
    const Option* option = find_parameter(name);
    const ParameterRow* row = find_row(name);
    if (option == nullptr && row == nullptr) return Setting::unknown;
    const std::string cleaned = clean(value);
    const std::string_view upper = without_trailing_blanks(cleaned);
    if (upper != "DEFAULT") {
        const bool keeps_case = name == dump_parameter.parameter;
        const std::string_view text = keeps_case ? std::string_view(value) : upper;
        const bool is_read = option != nullptr ? read_option(*option, upper, parameters.options)
                                               : row->read(parameters, text);
        return is_read ? Setting::accepted : Setting::refused;
    }
    if (option != nullptr)
        read_option(*option, write_option(*option, default_options()), parameters.options);
    if (row != nullptr) row->reset(parameters);
    return Setting::accepted;
}

bool set_tolerance(Parameters& parameters, std::string_view value) {
    return read_option(*find_parameter(tolerance_name), without_trailing_blanks(value),
                       parameters.options);
}

std::vector<const char*> own_parameter_names() {
    std::vector<const char*> names;
    for (const Option& option : option_table)
        if (is_own(option.parameter)) names.push_back(option.parameter);
    for (const ParameterRow& row : parameter_table)
        if (is_own(row.name)) names.push_back(row.name);
    return names;
}

void note_common(Parameters& parameters, std::string_view name, std::string_view value) {
    if (name == "LB_METHOD") parameters.rrcb = parameters.replace_rcb && value == "RCB";
    if (name == tolerance_name) note_tolerance(parameters.options, value);
    const ParameterRow* row = find_row(name);
    if (row != nullptr && (value == "DEFAULT" || !row->read(parameters, value)))
        row->reset(parameters);
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
