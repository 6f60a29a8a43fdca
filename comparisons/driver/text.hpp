#pragma once

#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons {

/// Returns the number that `text` consists of, or nullopt if it is anything else.
template <typename Number>
std::optional<Number> read_number(std::string_view text) {
    Number number{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}

/// Returns the shortest text that parses to the same number.
template <typename Number>
std::string write_number(Number number) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// Splits `text` at the separators that are outside square brackets.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Returns the names of things, separated by ", ". `name_of` returns the name of one.
template <typename Things, typename NameOf = std::identity>
std::string joined(const Things& things, NameOf name_of = {}) {
    std::string text;
    for (const auto& thing : things)
        text.append(text.empty() ? "" : ", ").append(std::invoke(name_of, thing));
    return text;
}

/// Returns `text` without blanks and carriage returns at both ends.
std::string_view trim(std::string_view text);

/// Returns `text` as a part of a file name: characters other than letters, digits and . _ - become
/// _.
std::string file_name_part(std::string_view text);

/// Returns `value` with `digits` digits after the decimal point.
std::string fixed(double value, int digits);

/// Returns `value` with nine digits, which is enough for pictures.
std::string nine_digits(double value);

}  // namespace comparisons
