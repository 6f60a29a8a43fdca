#include "bisection/domain_kinds.hpp"

#include <rrcb/error.hpp>

#include <string>

namespace rrcb {

namespace {

StatisticalDomain build_analytic(std::span<const CellMoments> cells, int dimension, const Box& box,
                                 const Options&) {
    return analytic_domain(cells, dimension, box);
}

StatisticalDomain build_sampled(std::span<const CellMoments> cells, int dimension, const Box&,
                                const Options& options) {
    return sampled_domain(cells, dimension, options);
}

// Extents of an analytic domain are estimates. The sampled domain stands for the paper's method,
// which refines nothing.
constexpr DomainTraits domain_kinds[] = {
    {DomainKind::analytic, false, Refine::tolerance, 0.9, build_analytic},
    {DomainKind::sampled, false, Refine::none, 1, build_sampled},
    {DomainKind::points, true, Refine::tolerance, 1, nullptr},
};

}  // namespace

const DomainTraits& traits_of(DomainKind kind) {
    for (const DomainTraits& traits : domain_kinds)
        if (traits.kind == kind) return traits;
    throw Error(ErrorCode::invalid_argument,
                "domain must be a value of rrcb::DomainKind, not number " +
                    std::to_string(static_cast<int>(kind)));
}

}  // namespace rrcb
