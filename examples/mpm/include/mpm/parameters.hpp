#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mpm {

/// Value of a parameter of a scene: a number, a word, or a list of numbers.
using Value = std::variant<double, std::string, std::vector<double>>;

/// Parameters by name, as a scene gives them.
using Parameters = std::map<std::string, Value>;

/// Rule for a parameter.
struct Rule {
    enum class Kind { number, word, list };

    std::string name;
    Kind kind = Kind::number;
    std::string unit = "";
    std::optional<Value> fallback = {};  ///< value where the scene gives none
    bool may_be_absent = false;          ///< its presence asks for something more
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool is_whole = false;
    bool without_ends = false;              ///< strictly between least and most
    std::vector<std::string> choices = {};  ///< of a word; empty: any
    bool has_any_length = false;  ///< of a list; otherwise it has one number for each axis
};

/// A number above 0.
Rule positive(std::string name, std::string unit, std::optional<double> fallback = {});
/// A number of at least 0.
Rule not_negative(std::string name, std::string unit, std::optional<double> fallback = {});
/// Any finite number.
Rule number(std::string name, std::string unit, std::optional<double> fallback = {});
/// A number from `least` to `most`, both included.
Rule within(std::string name, std::string unit, double least, double most,
            std::optional<double> fallback = {});
/// A whole number from `least` to `most`, both included.
Rule whole(std::string name, std::string unit, double least, double most,
           std::optional<double> fallback = {});
/// Numbers along the axes, as many as the scene has dimensions.
Rule vector(std::string name, std::string unit, std::optional<std::vector<double>> fallback = {});
/// Any number of numbers.
Rule rows(std::string name, std::string unit);
/// One of some words. The first is the fallback.
Rule choice(std::string name, std::vector<std::string> choices);
/// Rule for a parameter that may be left out altogether.
Rule optional(Rule rule);

/// Parameters that keep the rules, with the fallbacks filled in.
class Values {
  public:
    /// Throws std::invalid_argument whose text starts with `place`, names the key and tells what is
    /// allowed.
    Values(const Parameters& given, std::span<const Rule> rules, const std::string& place,
           int dimension);

    double number(std::string_view name) const;
    const std::string& word(std::string_view name) const;
    const std::vector<double>& list(std::string_view name) const;
    bool has(std::string_view name) const;

  private:
    std::map<std::string, Value, std::less<>> values_;
};

/// Words in one line, with commas between them.
std::string joined(std::span<const std::string> words);

}  // namespace mpm
