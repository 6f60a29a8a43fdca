#pragma once

#include <rrcb/paper.hpp>

#include <optional>
#include <string>
#include <string_view>

// Converts options of the paper's methods from and to text, for the plug-in and the comparisons.
// The readers accept only complete texts in upper case; for other texts they return false and set
// nothing. ANALYTIC is not accepted, because it is RRCB's own method.

namespace rrcb {

bool read_cut_rule(CutRule& rule, std::string_view text);
bool read_domain(std::optional<PaperDomain>& domain, std::string_view text);
bool read_sigma_multiplier(double& multiplier, std::string_view text);
bool read_sample_fraction(double& fraction, std::string_view text);
bool read_seed(std::uint64_t& seed, std::string_view text);

/// Return texts that the readers accept.
std::string name_of(CutRule rule);
std::string name_of(PaperDomain domain);

}  // namespace rrcb
