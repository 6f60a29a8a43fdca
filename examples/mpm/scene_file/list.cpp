#include "scene_file/list.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_TwoDArray.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace mpm {

namespace {

using Entry = Teuchos::ParameterEntry;

template <typename Number>
std::optional<Value> array_of(const Entry& entry) {
    if (!entry.isType<Teuchos::Array<Number>>()) return std::nullopt;
    const auto& array = Teuchos::getValue<Teuchos::Array<Number>>(entry);
    return std::vector<double>(array.begin(), array.end());
}

std::optional<Value> value_of(const Entry& entry) {
    if (entry.isType<int>()) return static_cast<double>(Teuchos::getValue<int>(entry));
    if (entry.isType<double>()) return Teuchos::getValue<double>(entry);
    if (entry.isType<std::string>()) return Teuchos::getValue<std::string>(entry);
    if (const auto integers = array_of<int>(entry)) return integers;
    return array_of<double>(entry);
}

template <typename Number>
bool append_rows(const Entry& entry, std::size_t width, std::vector<Vector>& rows) {
    if (!entry.isType<Teuchos::TwoDArray<Number>>()) return false;
    const auto& array = Teuchos::getValue<Teuchos::TwoDArray<Number>>(entry);
    if (static_cast<std::size_t>(array.getNumCols()) != width) return false;
    for (int i = 0; i < static_cast<int>(array.getNumRows()); ++i) {
        rows.emplace_back();
        for (std::size_t a = 0; a < width; ++a)
            rows.back()[a] = static_cast<double>(array(i, static_cast<int>(a)));
    }
    return true;
}

}  // namespace

std::vector<std::string> List::sublist_names() const {
    std::vector<std::string> names;
    for (auto entry = list_.begin(); entry != list_.end(); ++entry) {
        names.push_back(list_.name(entry));
        if (!list_.entry(entry).isList()) refuse(names.back(), "must be a list of its own");
    }
    return names;
}

List List::take_list(const std::string& name) {
    const std::string place = place_ + " / " + name;
    if (!list_.isParameter(name)) return {Teuchos::ParameterList(), place};
    if (!list_.isSublist(name)) refuse(name, "must be a list of its own");
    List taken(list_.sublist(name), place);
    list_.remove(name);
    return taken;
}

std::vector<Vector> List::take_rows(const std::string& name, int dimension) {
    std::vector<Vector> rows;
    const Entry* entry = list_.getEntryPtr(name);
    const auto width = static_cast<std::size_t>(dimension);
    if (entry == nullptr ||
        !(append_rows<double>(*entry, width, rows) || append_rows<int>(*entry, width, rows)))
        refuse(name, "must be rows of " + std::to_string(dimension) + " numbers");
    list_.remove(name);
    return rows;
}

Parameters List::parameters() const {
    Parameters parameters;
    for (auto entry = list_.begin(); entry != list_.end(); ++entry) {
        const std::string& name = list_.name(entry);
        const std::optional<Value> value = value_of(list_.entry(entry));
        if (!value) refuse(name, "must be a number, a word or a row of numbers");
        parameters[name] = *value;
    }
    return parameters;
}

void List::refuse_other_lists(const std::string& possible) const {
    for (auto entry = list_.begin(); entry != list_.end(); ++entry)
        if (list_.entry(entry).isList())
            refuse(list_.name(entry), "is not known here; possible lists: " + possible);
}

void List::refuse(const std::string& name, const std::string& text) const {
    throw std::invalid_argument(place_ + ": '" + name + "' " + text);
}

Vector vector_of(const std::vector<double>& numbers) {
    Vector vector{};
    std::ranges::copy(numbers, vector.begin());
    return vector;
}

}  // namespace mpm
