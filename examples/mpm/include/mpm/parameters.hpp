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

/// The value of a scene's parameter: a number, a word, or a list of numbers.
using Value = std::variant<double, std::string, std::vector<double>>;

/// Parameters by name, as a scene gives them.
using Parameters = std::map<std::string, Value>;

/// The rule that a parameter must satisfy.
struct Rule {
    enum class Kind { number, word, list };

    std::string name;
    Kind kind = Kind::number;
    std::string unit = "";
    std::optional<Value> fallback = {};  ///< value if the scene gives none
    bool may_be_absent = false;          ///< the parameter is optional and has no fallback
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool is_whole = false;
    bool without_ends = false;              ///< the value is strictly between least and most
    std::vector<std::string> choices = {};  ///< allowed words; empty: any word
    bool has_any_length = false;  ///< a list of any length is allowed; otherwise it has one number
                                  ///< per axis
};

/// Requires a number above 0.
Rule positive(std::string name, std::string unit, std::optional<double> fallback = {});
/// Requires a number of at least 0.
Rule not_negative(std::string name, std::string unit, std::optional<double> fallback = {});
/// Requires a finite number.
Rule number(std::string name, std::string unit, std::optional<double> fallback = {});
/// Requires a number from `least` to `most`, both included.
Rule within(std::string name, std::string unit, double least, double most,
            std::optional<double> fallback = {});
/// Requires a whole number from `least` to `most`, both included.
Rule whole(std::string name, std::string unit, double least, double most,
           std::optional<double> fallback = {});
/// Requires one number for each axis of the scene.
Rule vector(std::string name, std::string unit, std::optional<std::vector<double>> fallback = {});
/// Allows a list of any length.
Rule rows(std::string name, std::string unit);
/// Requires one of the words. The first is the default.
Rule choice(std::string name, std::vector<std::string> choices);
/// Makes a parameter optional.
Rule optional(Rule rule);

/// Parameters that satisfy their rules, with the defaults filled in.
class Values {
  public:
    /// Throws std::invalid_argument for a parameter that breaks its rule. The text starts with
    /// `place` and contains the parameter's name and the allowed values.
    Values(const Parameters& given, std::span<const Rule> rules, const std::string& place,
           int dimension);

    double number(std::string_view name) const;
    const std::string& word(std::string_view name) const;
    const std::vector<double>& list(std::string_view name) const;
    bool has(std::string_view name) const;

  private:
    std::map<std::string, Value, std::less<>> values_;
};

/// Returns the words in one line, separated by commas.
std::string joined(std::span<const std::string> words);

}  // namespace mpm
