#include "options/option_table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace rrcb {

namespace {

constexpr std::string_view automatic = "AUTO";

constexpr std::string_view no_values = "NONE";

template <class Kind>
constexpr bool is_range = requires(Kind kind) {
    kind.field;
};

template <class Number>
std::string text_of(Number number) {
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), number);
    return {text, end.ptr};
}

template <class Number>
bool lies_in(const Range<Number>& range, Number most, Number value) {
    if (range.zero != nullptr && value == 0) return true;
    return (range.above_least ? value > range.least : value >= range.least) && value <= most;
}

template <class Number>
bool is_bounded(const Range<Number>& range) {
    return range.most < std::numeric_limits<Number>::max();
}

std::string upper_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

bool equal_words(std::string_view a, std::string_view b) {
    return upper_case(a) == upper_case(b);
}

/// Returns the least number of letters to insert, delete or replace so that `part` occurs in
/// `text`.
std::size_t distance_within(std::string_view part, std::string_view text) {
    std::vector<std::size_t> row(text.size() + 1);
    for (std::size_t i = 0; i < part.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < text.size(); ++j) {
            const std::size_t replaced = diagonal + (part[i] == text[j] ? 0 : 1);
            diagonal = std::exchange(row[j + 1], std::min({replaced, row[j] + 1, row[j + 1] + 1}));
        }
    }
    return *std::ranges::min_element(row);
}

std::size_t distance_between(std::string_view a, std::string_view b) {
    return a.size() < b.size() ? distance_within(a, b) : distance_within(b, a);
}

/// Joins names as "A", "A or B", "A, B or C".
std::string choice_between(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        text += (k == 0 ? "" : k + 1 == names.size() ? " or " : ", ") + names[k];
    return text;
}

/// Returns the numbers in a text, which blanks or commas separate. Returns nullopt if the text
/// contains anything else.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto is_separator = [](char c) { return c == ' ' || c == '\t' || c == ','; };
    while ((at = std::find_if_not(at, end, is_separator)) != end) {
        const auto [stop, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc() || (stop != end && !is_separator(*stop))) return std::nullopt;
        at = stop;
    }
    return numbers;
}

std::string text_of(const Rows& rows, const Options& options) {
    const std::vector<double> numbers = rows.get(options);
    std::string text;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        text += (k == 0                                            ? ""
                 : rows.row_length > 1 && k % rows.row_length == 0 ? ", "
                                                                   : " ") +
                text_of(numbers[k]);
    return text.empty() ? std::string(no_values) : text;
}

bool read_rows(const Rows& rows, std::string_view text, Options& options) {
    if (equal_words(text, no_values)) return rows.set(options, {});
    const auto numbers = numbers_in(text);
    return numbers && !numbers->empty() && rows.set(options, *numbers);
}

/// Returns the limits of a range in words: ", 1 or more", " from 1 to 4096".
template <class Number>
std::string bounds_of(const Range<Number>& range) {
    const std::string least = text_of(range.least);
    if (range.above_least)
        return " above " + least + (is_bounded(range) ? ", at most " + text_of(range.most) : "");
    return is_bounded(range) ? " from " + least + " to " + text_of(range.most)
                             : ", " + least + " or more";
}

}  // namespace

const Option* find_option(std::string_view name) {
    for (const Option& option : option_table)
        if (!name.empty() && option.name == name) return &option;
    return nullptr;
}

const Option* find_parameter(std::string_view parameter) {
    for (const Option& option : option_table)
        if (!parameter.empty() && option.parameter == parameter) return &option;
    return nullptr;
}

std::vector<std::string> option_names() {
    std::vector<std::string> names;
    for (const Option& option : option_table)
        if (*option.name != '\0' && !std::holds_alternative<Lists>(option.kind))
            names.emplace_back(option.name);
    return names;
}

std::string suggestion(std::string_view given, const std::vector<std::string>& names) {
    if (given.size() < 3) return "";
    const std::string wanted = upper_case(given);
    std::size_t least = given.size();
    std::vector<std::string> nearest;
    for (const std::string& name : names) {
        const std::size_t distance = distance_between(wanted, upper_case(name));
        // If more letters differ, it is another word.
        if (distance > std::min({least, given.size() / 4, name.size() / 4})) continue;
        if (distance < least) nearest.clear();
        nearest.push_back(name);
        least = distance;
    }
    return nearest.empty() ? "" : "; did you mean " + choice_between(nearest) + '?';
}

bool is_legal(const Option& option, const Options& options, int dimension) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) {
        if constexpr (is_range<Kind>) {
            return lies_in(kind, dimension < 3 ? kind.most : kind.most_in_3d,
                           kind.field.get(options));
        } else if constexpr (std::is_same_v<Kind, Choice>) {
            return std::ranges::find(kind, kind.get(options), &Word::value) != kind.end();
        } else {
            return true;
        }
    });
}

std::string requirement(const Option& option, int dimension) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) -> std::string {
        if constexpr (is_range<Kind>) {
            const std::string least = text_of(kind.least);
            const std::string most = text_of(dimension < 3 ? kind.most : kind.most_in_3d);
            if (kind.above_least)
                return is_bounded(kind) ? "in (" + least + ", " + most + "]"
                                        : "finite and above " + least;
            const bool is_real = std::is_same_v<Kind, Range<double>>;
            if (kind.zero == nullptr)
                return (is_real ? "finite and at least " : "at least ") + least;
            return (is_bounded(kind) ? least + " ... " + most : std::string("positive")) +
                   kind.unit + ", or 0 for " + (is_bounded(kind) ? "the default" : kind.zero);
        } else {
            return legal_values(option);
        }
    });
}

std::string texts_of(const Option& option) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) {
        std::string text = legal_values(option);
        if constexpr (is_range<Kind>)
            if (kind.zero != nullptr)
                text += ", or 0 or " + std::string(automatic) + " for " + kind.zero;
        return text;
    });
}

std::string legal_values(const Option& option) {
    return visit_kind(option, []<class Kind>(const Kind& kind) -> std::string {
        if constexpr (std::is_same_v<Kind, Choice>) {
            std::vector<std::string> words;
            for (const Word& word : kind) words.emplace_back(word.word);
            return choice_between(words);
        } else if constexpr (is_range<Kind>) {
            const bool is_real = std::is_same_v<Kind, Range<double>>;
            return (is_real ? "a number" : "a whole number") + bounds_of(kind);
        } else if constexpr (std::is_same_v<Kind, Rows>) {
            return std::string(no_values) + ", or " + kind.text + ": " + kind.example;
        } else {
            return "a list";
        }
    });
}

std::string documentation(const Option& option) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) {
        std::string text = std::string(option.text) + ": " + legal_values(option);
        if constexpr (is_range<Kind>)
            if (kind.zero != nullptr) text += std::string("; 0: ") + kind.zero;
        return text + '.';
    });
}

bool read_option(const Option& option, std::string_view text, Options& options) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) {
        if constexpr (std::is_same_v<Kind, Choice>) {
            const auto same = [&](const Word& word) { return equal_words(word.word, text); };
            const auto* word = std::ranges::find_if(kind, same);
            if (word == kind.end()) return false;
            kind.set(options, word->value);
            return true;
        } else if constexpr (is_range<Kind>) {
            std::remove_const_t<decltype(kind.least)> value{};
            const bool is_automatic = kind.zero != nullptr && equal_words(text, automatic);
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            const bool is_number =
                error == std::errc() && stop == end && std::isfinite(static_cast<double>(value));
            if (!is_automatic && !(is_number && lies_in(kind, kind.most, value))) return false;
            kind.field.set(options, is_automatic ? 0 : value);
            return true;
        } else if constexpr (std::is_same_v<Kind, Rows>) {
            return read_rows(kind, text, options);
        } else {
            return false;
        }
    });
}

std::string write_option(const Option& option, const Options& options) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) -> std::string {
        if constexpr (std::is_same_v<Kind, Choice>) {
            return std::ranges::find(kind, kind.get(options), &Word::value)->word;
        } else if constexpr (is_range<Kind>) {
            const bool is_automatic = kind.zero != nullptr && kind.field.get(options) == 0;
            return is_automatic ? std::string(automatic) : text_of(kind.field.get(options));
        } else if constexpr (std::is_same_v<Kind, Rows>) {
            return text_of(kind, options);
        } else {
            return "";
        }
    });
}

}  // namespace rrcb
