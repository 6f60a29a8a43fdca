#pragma once

#include <rrcb/paper.hpp>

#include <string>
#include <string_view>

// Options of the paper's methods as text, for the plug-in and the comparisons. The readers take the
// whole text, words in upper case; an illegal one returns false and sets nothing.

namespace rrcb {

bool read_cut_rule(CutRule& rule, std::string_view text);
bool read_sigma_multiplier(double& multiplier, std::string_view text);
bool read_sample_fraction(double& fraction, std::string_view text);
bool read_seed(std::uint64_t& seed, std::string_view text);

/// Text of a rule, as read_cut_rule() takes it.
std::string name_of(CutRule rule);

}  // namespace rrcb
