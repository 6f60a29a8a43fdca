#pragma once

#include <rrcb/paper.hpp>

#include <optional>
#include <string>
#include <string_view>

// Options of the paper's methods as text, for the plug-in and the comparisons. Readers accept only
// complete texts, words in upper case; otherwise they return false and set nothing. ANALYTIC,
// RRCB's own method, is no domain of the paper.

namespace rrcb {

bool read_cut_rule(CutRule& rule, std::string_view text);
bool read_domain(std::optional<PaperDomain>& domain, std::string_view text);
bool read_sigma_multiplier(double& multiplier, std::string_view text);
bool read_sample_fraction(double& fraction, std::string_view text);
bool read_seed(std::uint64_t& seed, std::string_view text);

/// Return texts in the form of the readers.
std::string name_of(CutRule rule);
std::string name_of(PaperDomain domain);

}  // namespace rrcb
