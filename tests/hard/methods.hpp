#pragma once

#include "../support/common.hpp"

#include <rrcb/paper.hpp>

namespace rrcb::hard_test {

/// A refinement of RRCB, or a method of the paper, by the names of the parameters.
struct Method {
    std::optional<PaperDomain> paper;
    Refine refine;
    const char* domain_name;
    const char* refine_name;

    bool balances() const { return refine != Refine::none || paper == PaperDomain::points; }
    /// A call that starts from the cuts of the one before may stop at them.
    bool keeps_good_cuts() const { return !paper && refine == Refine::tolerance; }
    double tolerance() const;  ///< of what `balances`
};

inline constexpr double asked_tolerance = 1.05;

inline double Method::tolerance() const {
    return refine == Refine::tolerance ? asked_tolerance : 1;
}

inline constexpr std::array methods = {
    Method{std::nullopt, Refine::none, "ANALYTIC", "NONE"},
    Method{std::nullopt, Refine::tolerance, "ANALYTIC", "TOLERANCE"},
    Method{std::nullopt, Refine::exact, "ANALYTIC", "EXACT"},
    Method{PaperDomain::sampled, Refine::none, "SAMPLED", "NONE"},
    Method{PaperDomain::points, Refine::none, "POINTS", "NONE"},
};

inline constexpr std::span own_methods = std::span(methods).first(3);

/// Divides points by a method; those of the paper take the number and sizes of parts from
/// `options`.
inline Balance balance(const Points& points, const Method& method, Options options, MPI_Comm comm) {
    if (method.paper) {
        PaperOptions paper{.num_parts = options.num_parts, .part_sizes = options.part_sizes};
        paper.domain = *method.paper;
        return balance_as_in_paper(points, comm, paper);
    }
    options.refine = method.refine;
    return rrcb::balance(points, comm, options);
}

/// One part per rank; one rank alone makes five, so that it has something to divide.
inline int parts_for(int num_ranks) {
    return num_ranks == 1 ? 5 : num_ranks;
}

}  // namespace rrcb::hard_test
