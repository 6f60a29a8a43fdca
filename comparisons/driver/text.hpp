#pragma once

#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons {

/// The number that is the whole of `text`, or nothing.
template <typename Number>
std::optional<Number> read_number(std::string_view text) {
    Number number{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}

/// Shortest text that reads back as the same number.
template <typename Number>
std::string write_number(Number number) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// Pieces of `text` between separators that stand outside square brackets.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Names as in "a, b, c", of things of which `name_of` tells them.
template <typename Things, typename NameOf = std::identity>
std::string joined(const Things& things, NameOf name_of = {}) {
    std::string text;
    for (const auto& thing : things)
        text.append(text.empty() ? "" : ", ").append(std::invoke(name_of, thing));
    return text;
}

/// `text` without blanks and carriage returns at both ends.
std::string_view trim(std::string_view text);

/// `text` as a part of a file name: letters, digits and . _ - stay, the rest becomes _.
std::string file_name_part(std::string_view text);

/// `value` with a number of digits behind the point.
std::string fixed(double value, int digits);

/// `value` to nine digits, for pictures.
std::string nine_digits(double value);

/// 54464 as "54,464".
std::string grouped(std::int64_t number);

/// 1536 as "1.5 KiB".
std::string human_bytes(double bytes);

}  // namespace comparisons
