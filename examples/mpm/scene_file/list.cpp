#include "scene_file/list.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_TwoDArray.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

using Entry = Teuchos::ParameterEntry;

/// Takes a row of numbers, or rows one after the other. Returns whether the entry is one.
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

/// Returns what Teuchos says of a text, without places in its own source.
std::string readable(const std::string& message) {
    std::istringstream lines(message);
    std::string readable;
    for (std::string line; std::getline(lines, line);) {
        line = line.substr(0, line.find(" in list \"ANONYMOUS\""));
        if (!line.empty() && !line.starts_with("./") && !line.starts_with("Throw") &&
            !line.starts_with("error: Parser failure"))
            readable += "\n" + line;
    }
    return readable;
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
            "is not understood; it must be one list named scene, in YAML, each key once:" +
            readable(error.what()));
    }
    return converted(*list, "scene", "scene");
}

Vector vector_of(const std::vector<double>& numbers) {
    Vector vector{};
    std::ranges::copy(numbers, vector.begin());
    return vector;
}

}  // namespace mpm
