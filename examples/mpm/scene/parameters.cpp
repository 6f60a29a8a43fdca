#include <mpm/parameters.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

using Kind = Rule::Kind;

[[noreturn]] void refuse(const std::string& place, const std::string& name,
                         const std::string& text) {
    throw std::invalid_argument(place + ": '" + name + "' " + text);
}

std::string text_of(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string range_of(const Rule& rule) {
    const bool has_least = std::isfinite(rule.least), has_most = std::isfinite(rule.most);
    std::string text = rule.is_whole ? "a whole number" : "a finite number";
    const std::string below = rule.without_ends ? " above " : " of at least ";
    const std::string above = rule.without_ends ? " below " : " of at most ";
    if (has_least) text += below + text_of(rule.least);
    if (has_most) text += (has_least ? " and" : "") + above + text_of(rule.most);
    return rule.unit.empty() ? text : text + ", in " + rule.unit;
}

std::string wish_of(const Rule& rule, int dimension) {
    switch (rule.kind) {
        case Kind::number:
            return range_of(rule);
        case Kind::list:
            return "a list of " + (rule.has_any_length ? "" : std::to_string(dimension) + " ") +
                   "numbers, each " + range_of(rule);
        case Kind::word:
            return rule.choices.empty() ? "a word" : "one of: " + joined(rule.choices);
    }
    return {};
}

bool keeps(const Rule& rule, double value) {
    if (!std::isfinite(value) || (rule.is_whole && value != std::floor(value))) return false;
    if (rule.without_ends) return value > rule.least && value < rule.most;
    return value >= rule.least && value <= rule.most;
}

bool keeps(const Rule& rule, const Value& value, int dimension) {
    if (value.index() != static_cast<std::size_t>(rule.kind)) return false;
    if (rule.kind == Kind::number) return keeps(rule, std::get<double>(value));
    if (rule.kind == Kind::word)
        return rule.choices.empty() ||
               std::ranges::find(rule.choices, std::get<std::string>(value)) != rule.choices.end();
    const auto& list = std::get<std::vector<double>>(value);
    return (rule.has_any_length || list.size() == static_cast<std::size_t>(dimension)) &&
           std::ranges::all_of(list, [&](double entry) { return keeps(rule, entry); });
}

void check_names(const Parameters& given, std::span<const Rule> rules, const std::string& place) {
    std::vector<std::string> known;
    for (const Rule& rule : rules) known.push_back(rule.name);
    for (const auto& [name, value] : given)
        if (std::ranges::find(known, name) == known.end())
            refuse(place, name, "is not known here; possible: " + joined(known));
}

}  // namespace

Rule positive(std::string name, std::string unit, std::optional<double> fallback) {
    Rule rule = not_negative(std::move(name), std::move(unit), fallback);
    rule.without_ends = true;
    return rule;
}

Rule not_negative(std::string name, std::string unit, std::optional<double> fallback) {
    Rule rule = number(std::move(name), std::move(unit), fallback);
    rule.least = 0;
    return rule;
}

Rule number(std::string name, std::string unit, std::optional<double> fallback) {
    Rule rule{.name = std::move(name), .unit = std::move(unit)};
    if (fallback) rule.fallback = *fallback;
    return rule;
}

Rule within(std::string name, std::string unit, double least, double most,
            std::optional<double> fallback) {
    Rule rule = number(std::move(name), std::move(unit), fallback);
    rule.least = least;
    rule.most = most;
    return rule;
}

Rule whole(std::string name, std::string unit, double least, double most,
           std::optional<double> fallback) {
    Rule rule = within(std::move(name), std::move(unit), least, most, fallback);
    rule.is_whole = true;
    return rule;
}

Rule vector(std::string name, std::string unit, std::optional<std::vector<double>> fallback) {
    Rule rule{.name = std::move(name), .kind = Kind::list, .unit = std::move(unit)};
    if (fallback) rule.fallback = *fallback;
    return rule;
}

Rule rows(std::string name, std::string unit) {
    Rule rule = vector(std::move(name), std::move(unit));
    rule.has_any_length = true;
    return rule;
}

Rule choice(std::string name, std::vector<std::string> choices) {
    Rule rule{.name = std::move(name), .kind = Kind::word};
    rule.fallback = choices.front();
    rule.choices = std::move(choices);
    return rule;
}

Rule optional(Rule rule) {
    rule.may_be_absent = true;
    rule.fallback.reset();
    return rule;
}

Values::Values(const Parameters& given, std::span<const Rule> rules, const std::string& place,
               int dimension) {
    check_names(given, rules, place);
    for (const Rule& rule : rules) {
        const auto found = given.find(rule.name);
        if (found != given.end()) {
            if (!keeps(rule, found->second, dimension))
                refuse(place, rule.name, "must be " + wish_of(rule, dimension));
            values_[rule.name] = found->second;
        } else if (rule.fallback) {
            values_[rule.name] = *rule.fallback;
        } else if (!rule.may_be_absent) {
            refuse(place, rule.name, "is missing; it must be " + wish_of(rule, dimension));
        }
    }
}

double Values::number(std::string_view name) const {
    return std::get<double>(values_.find(name)->second);
}

const std::string& Values::word(std::string_view name) const {
    return std::get<std::string>(values_.find(name)->second);
}

const std::vector<double>& Values::list(std::string_view name) const {
    return std::get<std::vector<double>>(values_.find(name)->second);
}

bool Values::has(std::string_view name) const {
    return values_.find(name) != values_.end();
}

std::string joined(std::span<const std::string> words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
    return line;
}

}  // namespace mpm
