#pragma once

#include "options/option_table.hpp"

#include <limits>

// Parameters that only the plug-in has, with the defaults of PaperOptions, for the plug-in, the
// checks, the comparisons and Teuchos' list. This file must be valid C++17, because the header of
// Teuchos' validators is not valid C++20.

namespace rrcb {

/// Makes a choice whose value is not in any options, from its words and its default.
template <int initial, std::size_t num_words>
constexpr Choice unstored_choice(const Word (&words)[num_words]) {
    return {words, num_words, [](const Options&) { return initial; }, nullptr};
}

inline constexpr Word words_of_cut_rule[] = {
    {"WEIGHTED", 0, "the weight below is its parts' share"},
    {"MIDPOINT", 1, "the extent below is its parts' share"}};
inline constexpr Choice cut_rule_words = unstored_choice<0>(words_of_cut_rule);

/// Values of RRCB_DOMAIN. The first one is not a value of PaperOptions::domain.
inline constexpr Word words_of_method[] = {{"ANALYTIC", -1, "RRCB's own method"},
                                           {"SAMPLED", 0, "the paper's RRCB"},
                                           {"POINTS", 1, "the paper's RCB"}};
inline constexpr Word own_domain = words_of_method[0];
inline constexpr Choice domain_words{words_of_method + 1, 2, nullptr, nullptr};

inline constexpr Word words_of_dump_when[] = {{"FAILURE", 0, "when a call fails"},
                                              {"ALWAYS", 1, "at every call"}};

inline constexpr Range<double> sigma_range{
    {[](const Options&) { return 1.5; }, nullptr}, 0, std::numeric_limits<double>::max(), true};
inline constexpr Range<double> fraction_range{
    {[](const Options&) { return 1.0; }, nullptr}, 0, 1, true};

// The values of these parameters are not in any options.
inline constexpr Option domain_parameter{"", "RRCB_DOMAIN", "Plug-in only: the method",
                                         unstored_choice<-1>(words_of_method)};
inline constexpr Option cut_rule_parameter{
    "", "RRCB_CUT_RULE", "Plug-in only, SAMPLED and POINTS: position of cuts", cut_rule_words};
inline constexpr Option sigma_parameter{
    "", "RRCB_SIGMA_MULTIPLIER",
    "Plug-in only, SAMPLED: half-width of a cell's sampling box in standard deviations",
    sigma_range};
inline constexpr Option fraction_parameter{"", "RRCB_SAMPLE_FRACTION",
                                           "Plug-in only, SAMPLED: points drawn per real point",
                                           fraction_range};
inline constexpr Option dump_when_parameter{"", "RRCB_DUMP_WHEN",
                                            "Plug-in only: when to write to RRCB_DUMP",
                                            unstored_choice<0>(words_of_dump_when)};
inline constexpr Option plug_in_table[] = {domain_parameter, cut_rule_parameter, sigma_parameter,
                                           fraction_parameter, dump_when_parameter};

/// A parameter that is not in Options: a number of 64 bits, or a path.
struct OtherParameter {
    const char* parameter;
    const char* documentation;
};
inline constexpr OtherParameter seed_parameter{
    "RRCB_SEED", "Plug-in only, SAMPLED: seed of the points: a whole number, 0 or more."};
inline constexpr OtherParameter dump_parameter{
    "RRCB_DUMP", "Plug-in only: folder to write the input of calls to: a string; empty: none."};

}  // namespace rrcb
