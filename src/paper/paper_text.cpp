#include "paper/paper_text.hpp"

#include <charconv>
#include <limits>

namespace rrcb {

namespace {

template <class Number>
bool read_number(Number& number, std::string_view text) {
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) return false;
    number = value;
    return true;
}

/// Reads a number above 0, at most `most`.
bool read_positive(double& number, std::string_view text, double most) {
    double value = 0;
    if (!read_number(value, text) || !(value > 0 && value <= most)) return false;
    number = value;
    return true;
}

}  // namespace

bool read_cut_rule(CutRule& rule, std::string_view text) {
    for (const CutRule each : {CutRule::weighted_fraction, CutRule::midpoint}) {
        if (text != name_of(each)) continue;
        rule = each;
        return true;
    }
    return false;
}

bool read_sigma_multiplier(double& multiplier, std::string_view text) {
    return read_positive(multiplier, text, std::numeric_limits<double>::max());
}

bool read_sample_fraction(double& fraction, std::string_view text) {
    return read_positive(fraction, text, 1);
}

bool read_seed(std::uint64_t& seed, std::string_view text) {
    return read_number(seed, text);
}

std::string name_of(CutRule rule) {
    return rule == CutRule::midpoint ? "MIDPOINT" : "WEIGHTED";
}

}  // namespace rrcb
