#pragma once

#include <rrcb/options.hpp>

#include <array>

namespace rrcb::hard_test {

/// A statistical domain with a refinement, by the names of the options and of the parameters.
struct Method {
    DomainKind domain;
    Refine refine;
    const char* domain_name;
    const char* refine_name;

    bool balances() const { return refine != Refine::none || domain == DomainKind::points; }
    /// A call that starts from the cuts of the one before may stop at them.
    bool keeps_good_cuts() const {
        return domain == DomainKind::analytic && refine == Refine::tolerance;
    }
    double tolerance() const;  ///< of what `balances`
};

inline constexpr double asked_tolerance = 1.05;

inline double Method::tolerance() const {
    const bool exact = refine == Refine::exact || domain == DomainKind::points;
    return exact ? 1 : asked_tolerance;
}

inline constexpr std::array methods = {
    Method{DomainKind::analytic, Refine::none, "ANALYTIC", "NONE"},
    Method{DomainKind::analytic, Refine::tolerance, "ANALYTIC", "TOLERANCE"},
    Method{DomainKind::analytic, Refine::exact, "ANALYTIC", "EXACT"},
    Method{DomainKind::sampled, Refine::none, "SAMPLED", "NONE"},
    Method{DomainKind::sampled, Refine::tolerance, "SAMPLED", "TOLERANCE"},
    Method{DomainKind::sampled, Refine::exact, "SAMPLED", "EXACT"},
    Method{DomainKind::points, Refine::none, "POINTS", "NONE"},
    Method{DomainKind::points, Refine::tolerance, "POINTS", "TOLERANCE"},
    Method{DomainKind::points, Refine::exact, "POINTS", "EXACT"},
};

/// One part per rank; one rank alone makes five, so that it has something to divide.
inline int parts_for(int num_ranks) {
    return num_ranks == 1 ? 5 : num_ranks;
}

}  // namespace rrcb::hard_test
