#include "bisection/common_weight.hpp"

#include "bisection/patches.hpp"
#include "cuts/tree.hpp"

#include <utility>

namespace rrcb {

namespace {

/// Calls visit(end, domain) for each end of the tree below a node, with the part of the domain
/// inside it.
template <class Visit>
void visit_ends(StatisticalDomain domain, const Descent& at, const Cuts& cuts, Visit&& visit) {
    if (domain.patches.empty()) return;
    if (at.is_part()) return visit(at.first_part, std::move(domain));
    Halves halves = split_domain(std::move(domain), cuts.tree[at.node]);
    visit_ends(std::move(halves.lower), at.lower(), cuts, visit);
    visit_ends(std::move(halves.upper), at.upper(), cuts, visit);
}

}  // namespace

std::vector<CommonWeight> common_weights(StatisticalDomain domain, const Cuts& cuts,
                                         const Cuts& others) {
    std::vector<CommonWeight> common;
    visit_ends(std::move(domain), root_of(cuts), cuts, [&](Part end, StatisticalDomain&& piece) {
        visit_ends(std::move(piece), root_of(others), others,
                   [&](Part other, const StatisticalDomain& shared) {
                       const double weight = weight_of(shared);
                       if (weight > 0) common.push_back({end, others.part_at(other), weight});
                   });
    });
    return common;
}

}  // namespace rrcb
