#include "scene_file/list.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_TwoDArray.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

using Entry = Teuchos::ParameterEntry;

/// Reads a row of numbers, or several rows. Returns false if the entry is neither.
template <typename Number>
bool take_numbers(const Entry& entry, Value& value) {
    if (entry.isType<Number>()) value = static_cast<double>(Teuchos::getValue<Number>(entry));
    if (entry.isType<Teuchos::Array<Number>>()) {
        const auto& row = Teuchos::getValue<Teuchos::Array<Number>>(entry);
        value = std::vector<double>(row.begin(), row.end());
    }
    if (entry.isType<Teuchos::TwoDArray<Number>>()) {
        const auto& rows = Teuchos::getValue<Teuchos::TwoDArray<Number>>(entry);
        const auto numbers = rows.getDataArray();
        if (rows.getNumCols() != 2) return false;
        value = std::vector<double>(numbers.begin(), numbers.end());
    }
    return entry.isType<Number>() || entry.isType<Teuchos::Array<Number>>() ||
           entry.isType<Teuchos::TwoDArray<Number>>();
}

List converted(const Teuchos::ParameterList& from, const std::string& name,
               const std::string& place) {
    List list{name, place, {}, {}};
    for (auto at = from.begin(); at != from.end(); ++at) {
        const std::string& key = from.name(at);
        const Entry& entry = from.entry(at);
        Value value;
        if (entry.isList())
            list.lists.push_back(converted(from.sublist(key), key, place + " / " + key));
        else if (entry.isType<std::string>())
            list.parameters[key] = Teuchos::getValue<std::string>(entry);
        else if (take_numbers<int>(entry, value) || take_numbers<double>(entry, value))
            list.parameters[key] = value;
        else
            list.refuse(key, "must be a number, a word, a row of numbers or rows of two");
    }
    return list;
}

/// Returns a line of a text without the spaces around it. The first line has the number 1.
std::string line_of(const std::string& text, int number) {
    std::istringstream lines(text);
    std::string line;
    while (number-- > 0) std::getline(lines, line);
    const std::size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    return begin == std::string::npos ? "" : line.substr(begin, end + 1 - begin);
}

/// Returns in one line the fault that Teuchos has found in a text of YAML.
std::string fault_of(const std::string& text, const std::string& message) {
    constexpr const char* bad_character = "Unexpected character code";
    std::istringstream lines(message);
    std::string before, fault = "its brackets, colons or indents do not match";
    for (std::string line; std::getline(lines, line); before = line) {
        if (line.find("already exists") != std::string::npos)
            return line.substr(0, line.find(" in list \"ANONYMOUS\""));
        const std::size_t at = line.find(" at line ");
        if (line.find(bad_character) != std::string::npos && at != std::string::npos) {
            const int number = std::atoi(line.c_str() + at + 9);
            return "line " + std::to_string(number) + ", '" + line_of(text, number) +
                   "', has a character that is not ASCII";
        }
        // The parser marks a place in the previous line by a caret below it.
        if (!line.empty() && line.find_first_not_of(' ') == line.find('^') && !before.empty())
            fault = "near '" + line_of(before, 1) + "'";
    }
    return fault;
}

}  // namespace

List List::list(const std::string& wanted) const {
    if (parameters.contains(wanted)) refuse(wanted, "must be a list of its own");
    const auto found = std::ranges::find(lists, wanted, &List::name);
    return found == lists.end() ? List{wanted, place + " / " + wanted, {}, {}} : *found;
}

std::vector<List> List::lists_in(const std::string& wanted) const {
    const List found = list(wanted);
    for (const auto& [key, value] : found.parameters)
        found.refuse(key, "must be a list of its own");
    return found.lists;
}

void List::check_lists(const std::vector<std::string>& possible) const {
    for (const List& one : lists)
        if (std::ranges::find(possible, one.name) == possible.end())
            refuse(one.name, "is not known here; possible lists: " + joined(possible));
}

Values List::values(const std::vector<Rule>& rules, int dimension,
                    const std::vector<std::string>& possible) const {
    check_lists(possible);
    return {parameters, rules, place, dimension};
}

void List::refuse(const std::string& key, const std::string& text) const {
    throw std::invalid_argument(place + ": '" + key + "' " + text);
}

List parse_list(const std::string& text) {
    Teuchos::RCP<Teuchos::ParameterList> list;
    try {
        list = Teuchos::getParametersFromYamlString(text);
    } catch (const std::exception& error) {
        throw std::invalid_argument(
            "is not understood; it must be one list named scene, in YAML, each key once: " +
            fault_of(text, error.what()));
    }
    if (list->name() != "scene")
        throw std::invalid_argument("must be one list named scene, not '" + list->name() + "'");
    return converted(*list, "scene", "scene");
}

Vector vector_of(const std::vector<double>& numbers) {
    Vector vector{};
    std::ranges::copy(numbers, vector.begin());
    return vector;
}

}  // namespace mpm
