#pragma once

#include "options/option_table.hpp"

#include <iterator>

// The words of the paper's enumerations, in order of their values, for the checks, the plug-in, the
// comparisons and Teuchos' list. C++17, as the header of Teuchos' validators is not valid C++20.

namespace rrcb {

inline constexpr Word words_of_cut_rule[] = {
    {"WEIGHTED", 0, "the weight below is its parts' share"},
    {"MIDPOINT", 1, "the extent below is its parts' share"},
};
inline constexpr Choice cut_rule_words{words_of_cut_rule, std::size(words_of_cut_rule), nullptr,
                                       nullptr};

inline constexpr Word words_of_domain[] = {
    {"SAMPLED", 0, "the paper's RRCB"},
    {"POINTS", 1, "the paper's RCB"},
};
inline constexpr Choice domain_words{words_of_domain, std::size(words_of_domain), nullptr, nullptr};

/// RRCB_DOMAIN for RRCB's own method, in addition to the words of PaperOptions::domain.
inline constexpr Word own_domain{"ANALYTIC", -1, "RRCB's own method"};

}  // namespace rrcb
