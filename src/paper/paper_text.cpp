#include "paper/paper_text.hpp"

#include "paper/paper_words.hpp"

#include <algorithm>
#include <charconv>

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

bool read_above(const Range<double>& range, double& number, std::string_view text) {
    double value = 0;
    if (!read_number(value, text) || !(value > range.least && value <= range.most)) return false;
    number = value;
    return true;
}

const Word* find_word(const Choice& words, std::string_view text) {
    const auto* found = std::ranges::find(words, text, &Word::word);
    return found == words.end() ? nullptr : found;
}

}  // namespace

bool read_cut_rule(CutRule& rule, std::string_view text) {
    const Word* word = find_word(cut_rule_words, text);
    if (word != nullptr) rule = static_cast<CutRule>(word->value);
    return word != nullptr;
}

bool read_domain(std::optional<PaperDomain>& domain, std::string_view text) {
    const Word* word = find_word(domain_words, text);
    if (word != nullptr) domain = static_cast<PaperDomain>(word->value);
    if (text == own_domain.word) domain.reset();
    return word != nullptr || text == own_domain.word;
}

bool read_sigma_multiplier(double& multiplier, std::string_view text) {
    return read_above(sigma_range, multiplier, text);
}

bool read_sample_fraction(double& fraction, std::string_view text) {
    return read_above(fraction_range, fraction, text);
}

bool read_seed(std::uint64_t& seed, std::string_view text) {
    return read_number(seed, text);
}

std::string name_of(CutRule rule) {
    return cut_rule_words.words[static_cast<int>(rule)].word;
}

std::string name_of(PaperDomain domain) {
    return domain_words.words[static_cast<int>(domain)].word;
}

}  // namespace rrcb
