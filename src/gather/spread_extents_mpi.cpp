#include "gather/spread_extents_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "arithmetic/position_order.hpp"
#include "bisection/axis_choice.hpp"
#include "cuts/owned_cuts.hpp"
#include "gather/kept_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace rrcb {

namespace {

using CutWords = std::array<double, sizeof(Cut) / sizeof(double)>;

/// Extents of the points on both sides of a cut. Only the ends that face the other side and the
/// boxes are complete; the count is 1 if there are points.
struct FacingExtents {
    Extent below, above;
};

/// Calls `visit` with each of the 2 dimension (dimension + 1) doubles that describe the sides.
template <class AnyPlaces, class Visit>
void for_each_double_of_both(AnyPlaces& sides, int dimension, Visit&& visit) {
    for (int a = 0; a < dimension; ++a) {
        visit(sides.below.first[a][a]);
        visit(sides.above.last[a][a]);
        for (int b = 0; b < dimension; ++b) {
            visit(sides.below.last[a][b]);
            visit(sides.above.first[a][b]);
        }
    }
}

void append_facing(const FacingExtents& sides, int dimension, std::vector<double>& doubles) {
    for_each_double_of_both(sides, dimension, [&](double value) { doubles.push_back(value); });
}

FacingExtents read_facing(std::span<const double> doubles, int dimension) {
    FacingExtents sides;
    auto from = doubles.begin();
    for_each_double_of_both(sides, dimension, [&](double& value) { value = *from++; });
    for (Extent* side : {&sides.below, &sides.above})
        side->count = std::isfinite(side->first[0][0]) ? 1 : 0;
    return sides;
}

template <int dimension>
void join_sides(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    FacingExtents sides = read_facing(a, dimension);
    const FacingExtents others = read_facing(b, dimension);
    join(sides.below, others.below, dimension);
    join(sides.above, others.above, dimension);
    append_facing(sides, dimension, joined);
}

constexpr std::array<Butterfly::Join, max_dimension> joins{join_sides<1>, join_sides<2>,
                                                           join_sides<3>};

/// Calls visit(node, is_above) for each node with a cut above a part; the keys ascend.
template <class Visit>
void for_each_above(Part part, const Options& options, Visit&& visit) {
    for (Descent at = root_of(options.num_parts, options.tree); !at.is_part();
         at = at.towards(part))
        visit(at, at.is_above(part));
}

}  // namespace

SpreadExtents::SpreadExtents(const Options& options, const Extent& mine, bool may_keep,
                             int dimension, int rank)
    : options_(options),
      mine_(mine),
      may_keep_(may_keep),
      dimension_(dimension),
      butterfly_(rank, options.num_parts, joins[dimension - 1]) {}

std::optional<SpreadKeptTree> SpreadExtents::read(double total, bool by_count, Participant& self) {
    self.attempt([&] { tell_extents(); });
    messages_.run(butterfly_, Butterfly::to_owners,
                  {0, may_keep_ ? 0.0 : 1.0, share(total, by_count)}, self);
    const double imbalance = butterfly_.flags()[2];
    if (butterfly_.flags()[1] > 0) return std::nullopt;
    bool are_cut = false;
    self.attempt([&] { are_cut = decide_cuts(); });
    messages_.run(butterfly_, Butterfly::back, {0, are_cut ? 0.0 : 1.0}, self);
    if (butterfly_.flags()[1] > 0) return std::nullopt;
    SpreadKeptTree parts;
    self.attempt([&] { parts = parts_told(); });
    parts.imbalance = imbalance;
    return parts;
}

/// Returns the weight of the points of this rank over the ideal weight of its part.
double SpreadExtents::share(double total, bool by_count) const {
    const double weight = by_count ? mine_.count : mine_.weight;
    const auto& sizes = options_.part_sizes;
    const double all_sizes =
        sizes.empty() ? options_.num_parts : std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const double size = sizes.empty() ? 1 : sizes[butterfly_.rank()];
    if (mine_.count > 0 && !(size > 0)) return std::numeric_limits<double>::infinity();
    return over_ideal(weight, total, size / all_sizes);
}

void SpreadExtents::tell_extents() {
    std::vector<double> payload;
    for_each_above(butterfly_.rank(), options_, [&](const Descent& at, bool is_above) {
        payload.clear();
        append_facing({is_above ? Extent{} : mine_, is_above ? mine_ : Extent{}}, dimension_,
                      payload);
        butterfly_.add(at.node, owner_of(at, options_.num_parts, options_.num_parts), payload);
    });
}

/// Answers with the cuts of the nodes that this rank owns; returns false if one has none.
bool SpreadExtents::decide_cuts() {
    bool are_cut = true;
    butterfly_.owned().for_each([&](const Record& record) {
        const FacingExtents sides = read_facing(record.payload, dimension_);
        const std::optional<Cut> cut = cut_of(record.key, sides.below, sides.above);
        are_cut = are_cut && cut;
        if (cut) butterfly_.answer(record.key, std::bit_cast<CutWords>(*cut));
    });
    return are_cut;
}

/// Tries the axis that a new cut would have, then the other long ones.
std::optional<Cut> SpreadExtents::cut_of(std::size_t node, const Extent& below,
                                         const Extent& above) const {
    Extent all = below;
    join(all, above, dimension_);
    const Box box = all.box();
    const AxisOrder& order = options_.axes.order;
    const bool is_given = order.is_given();
    const int usual = is_given ? order.axes()[node] : longest_axis(box, dimension_, near_longest);
    for (int k = 0; k < (is_given ? 1 : dimension_); ++k) {
        const auto axis = static_cast<int>(ordering_axis(usual, k));
        if (!is_given && !is_long(box, axis, dimension_)) continue;
        const auto cut = cut_between(below, above, axis, dimension_, options_.axes.plain,
                                     options_.coincident == Coincident::divide);
        if (cut) return cut;
    }
    return std::nullopt;
}

/// Returns the cuts above the part of this rank, from the answers, which may include those for
/// other ranks.
SpreadKeptTree SpreadExtents::parts_told() const {
    SpreadKeptTree parts{{dimension_, options_.num_parts, {}, {}, options_.tree}};
    RecordReader answers = butterfly_.answers().read();
    for_each_above(butterfly_.rank(), options_, [&](const Descent& at, bool) {
        while (!answers.at_end()) {
            const Record answer = answers.next();
            if (answer.key != at.node) continue;
            CutWords words;
            std::ranges::copy(answer.payload, words.begin());
            const auto cut = std::bit_cast<Cut>(words);
            parts.cuts.nodes.push_back(static_cast<std::int32_t>(at.node));
            parts.cuts.tree.push_back(cut);
            const bool is_own = answer.owner == butterfly_.rank();
            parts.num_divided += is_own ? cut.divides : 0;
            return;
        }
    });
    return parts;
}

}  // namespace rrcb
