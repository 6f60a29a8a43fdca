#include "bisection/domain_kinds.hpp"

#include <rrcb/error.hpp>

#include <string>

namespace rrcb {

namespace {

StatisticalDomain build_analytic(const CellSet& set, int dimension, const Box& box,
                                 const Options&) {
    return analytic_domain(set.cells, dimension, box);
}

StatisticalDomain build_sampled(const CellSet& set, int dimension, const Box&,
                                const Options& options) {
    return sampled_domain(set.cells, dimension, options);
}

// Extents of an analytic domain are estimates. The sampled domain stands for the
// paper's method, which refines nothing.
constexpr DomainTraits domain_kinds[] = {
    {.kind = DomainKind::analytic,
     .sends_points = false,
     .has_lean_cells = true,
     .builds_on_last = true,
     .is_random = false,
     .automatic_refine = Refine::tolerance,
     .share_of_longest = 0.9,
     .build = build_analytic},
    {.kind = DomainKind::sampled,
     .sends_points = false,
     .has_lean_cells = false,
     .builds_on_last = false,
     .is_random = true,
     .automatic_refine = Refine::none,
     .share_of_longest = 1,
     .build = build_sampled},
    {.kind = DomainKind::points,
     .sends_points = true,
     .has_lean_cells = false,
     .builds_on_last = false,
     .is_random = false,
     .automatic_refine = Refine::tolerance,
     .share_of_longest = 1,
     .build = nullptr},
};

}  // namespace

const DomainTraits& traits_of(DomainKind kind) {
    for (const DomainTraits& traits : domain_kinds)
        if (traits.kind == kind) return traits;
    throw Error(ErrorCode::invalid_argument,
                "domain must be a value of rrcb::DomainKind, not number " +
                    std::to_string(static_cast<int>(kind)));
}

Options complete(Options options, int num_ranks) {
    if (options.num_parts == 0) options.num_parts = num_ranks;
    if (options.refine == Refine::automatic)
        options.refine = traits_of(options.domain).automatic_refine;
    if (!options.grid.empty()) options.plain_cuts = true;
    return options;
}

}  // namespace rrcb
