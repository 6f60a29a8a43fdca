#pragma once

#include "options/option_table.hpp"

#include <string>

// The words of the paper's enumerations, for the checks, the plug-in, the comparisons and Teuchos'
// list. C++17, as the header of Teuchos' validators is no C++20.

namespace rrcb {

/// Words of one enumeration in its order; the value of each is its number there.
struct PaperWords {
    const Word* first;
    std::size_t count;

    const Word* begin() const { return first; }
    const Word* end() const { return first + count; }
    bool has(int value) const { return value >= first->value && value <= end()[-1].value; }
};

inline constexpr Word words_of_cut_rule[] = {
    {"WEIGHTED", 0, "the weight below is its parts' share"},
    {"MIDPOINT", 1, "the extent below is its parts' share"},
};
inline constexpr PaperWords cut_rule_words{words_of_cut_rule, std::size(words_of_cut_rule)};

inline constexpr Word words_of_domain[] = {
    {"SAMPLED", 0, "the paper's RRCB"},
    {"POINTS", 1, "the paper's RCB"},
};
inline constexpr PaperWords domain_words{words_of_domain, std::size(words_of_domain)};

/// RRCB_DOMAIN for RRCB's own method, beside the words of PaperOptions::domain.
inline constexpr Word own_domain{"ANALYTIC", -1, "RRCB's own method"};

}  // namespace rrcb
