#include "search/undecided_points.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/running_sums.hpp"
#include "cuts/tree.hpp"
#include "passes/assignment.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace rrcb {

namespace {

constexpr LocalIndex points_in_block = 512;

/// Shrinks the box of each part to the positions that no cut can leave to another part.
void shrink(const Cuts& cuts, std::span<const Slab> slabs, const Descent& at, const Box& box,
            std::vector<Box>& boxes) {
    if (at.is_part()) {
        boxes.push_back(box);
        return;
    }
    const int axis = cuts.tree[at.node].axis;
    const Slab& slab = slabs[at.node];
    Box below = box;
    Box above = box;
    below.upper[axis] = std::min(box.upper[axis], slab.lower);
    above.lower[axis] = std::max(box.lower[axis], slab.upper);
    shrink(cuts, slabs, at.lower(), below, boxes);
    shrink(cuts, slabs, at.upper(), above, boxes);
}

std::vector<Box> decided_boxes(const Cuts& cuts, std::span<const Slab> slabs) {
    Box all;
    all.lower.fill(-infinity);
    all.upper.fill(infinity);
    std::vector<Box> boxes;
    shrink(cuts, slabs, root_of(cuts), all, boxes);
    return boxes;
}

/// Takes the points that are not in the box of their part, block by block.
template <class Layout, bool Weighted>
class Selection {
    static constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);

  public:
    Selection(const Layout& x, const Points& points, std::span<const Part> parts,
              const std::vector<Box>& boxes, UndecidedPoints& selected)
        : x_(x),
          points_(points),
          parts_(parts),
          boxes_(boxes),
          sums_(boxes.size()),
          selected_(selected) {}

    void run() {
        in_ranges(points_.count, sums_.interval(), [&](LocalIndex begin, LocalIndex end) {
            in_ranges(end - begin, points_in_block, [&](LocalIndex first, LocalIndex last) {
                take(begin + first, begin + last);
            });
            sums_.empty();
        });
        selected_.decided_weights = sums_.totals();
    }

  private:
    bool is_decided(LocalIndex i) const {
        const Box& box = boxes_[parts_[i]];
        int is_inside = 1;
        for (std::size_t a = 0; a < dimension; ++a) {
            const double value = x_(i, static_cast<int>(a));
            is_inside &= (value >= box.lower[a] ? 1 : 0) & (value < box.upper[a] ? 1 : 0);
        }
        return is_inside != 0;
    }

    /// Without branches in the loop, because the points come in any order.
    void take(LocalIndex first, LocalIndex last) {
        std::array<LocalIndex, points_in_block> undecided;
        std::size_t num_undecided = 0;
        for (LocalIndex i = first; i < last; ++i) {
            const bool decided = is_decided(i);
            undecided[num_undecided] = i;
            num_undecided += decided ? 0 : 1;
            const double weight = Weighted ? points_.weights[i] : 1.0;
            sums_[parts_[i]] += decided ? weight : 0.0;
        }
        append(std::span(undecided).first(num_undecided));
    }

    void append(std::span<const LocalIndex> indices) {
        const std::size_t before = selected_.original.size();
        selected_.original.insert(selected_.original.end(), indices.begin(), indices.end());
        selected_.coordinates.resize((before + indices.size()) * dimension);
        selected_.parts.resize(before + indices.size());
        if (Weighted) selected_.weights.resize(before + indices.size());
        for (std::size_t k = 0; k < indices.size(); ++k) {
            const LocalIndex i = indices[k];
            for (std::size_t a = 0; a < dimension; ++a)
                selected_.coordinates[(before + k) * dimension + a] = x_(i, static_cast<int>(a));
            selected_.parts[before + k] = parts_[i];
            if (Weighted) selected_.weights[before + k] = points_.weights[i];
        }
    }

    Layout x_;
    const Points& points_;
    std::span<const Part> parts_;
    const std::vector<Box>& boxes_;
    RunningSums<double> sums_;
    UndecidedPoints& selected_;
};

/// A moving cut on the way to a part.
struct Step {
    Descent at;
    bool above;
};

void add_ways(const Cuts& cuts, std::span<const Slab> slabs, const Descent& at,
              std::vector<Step>& way, std::vector<std::vector<Step>>& ways) {
    if (at.is_part()) {
        ways.push_back(way);
        return;
    }
    const bool moves = slabs[at.node].moves();
    if (moves) way.push_back({at, false});
    add_ways(cuts, slabs, at.lower(), way, ways);
    if (moves) way.back().above = true;
    add_ways(cuts, slabs, at.upper(), way, ways);
    if (moves) way.pop_back();
}

/// Returns the moving cuts on the way to each part.
std::vector<std::vector<Step>> ways_to_parts(const Cuts& cuts, std::span<const Slab> slabs) {
    std::vector<Step> way;
    std::vector<std::vector<Step>> ways;
    add_ways(cuts, slabs, root_of(cuts), way, ways);
    return ways;
}

/// Returns the part of a position if it were on the other side of the cut of a node.
Part part_across(const Cuts& cuts, const Step& step, const Vector& position) {
    Descent at = step.above ? step.at.lower() : step.at.upper();
    while (!at.is_part()) {
        const Cut& cut = cuts.tree[at.node];
        const int axis = cut.axis;
        const bool above = position[axis] == cut.at[axis] ? is_above(cut, position, cuts.dimension)
                                                          : position[axis] > cut.at[axis];
        at = above ? at.upper() : at.lower();
    }
    return at.first_part;
}

}  // namespace

UndecidedPoints undecided_points(const Points& points, std::span<const Part> parts,
                                 const Cuts& cuts, std::span<const Slab> slabs,
                                 UndecidedPoints memory) {
    const std::vector<Box> boxes = decided_boxes(cuts, slabs);
    UndecidedPoints selected = std::move(memory);
    selected.dimension = points.dimension;
    selected.coordinates.clear();
    selected.weights.clear();
    selected.original.clear();
    selected.parts.clear();
    visit_layout(points, [&]<class Layout>(const Layout& x) {
        if (points.weights.empty())
            return Selection<Layout, false>(x, points, parts, boxes, selected).run();
        Selection<Layout, true>(x, points, parts, boxes, selected).run();
    });
    return selected;
}

void count_in_slabs(const UndecidedPoints& points, const Cuts& cuts, std::span<const Slab> slabs,
                    std::span<double> counts) {
    const std::vector<std::vector<Step>> ways = ways_to_parts(cuts, slabs);
    const int d = points.dimension;
    for (LocalIndex i = 0; i < points.parts.size(); ++i) {
        Vector position{};
        for (int a = 0; a < d; ++a) position[a] = points.coordinates[i * d + a];
        const Part part = points.parts[i];
        for (const Step& step : ways[part]) {
            const Slab& slab = slabs[step.at.node];
            const Cut& cut = cuts.tree[step.at.node];
            const int axis = cut.axis;
            const double x = position[axis];
            if (!(x >= slab.lower && x < slab.upper)) continue;
            const auto bin = bin_in(counts, step.at, slab, step.above,
                                    bin_of(slab, cut.at[axis], step.above, x));
            const Part across = part_across(cuts, step, position);
            bin[part - step.at.first_part] += points.weight(i);
            bin[across - step.at.first_part] += points.weight(i);
        }
    }
}

void assign_undecided(const Cuts& cuts, UndecidedPoints& points, std::span<Part> parts,
                      std::span<double> part_weights) {
    const PartTotals totals = assign_and_count(cuts, points.points(), points.parts);
    for (std::size_t k = 0; k < points.original.size(); ++k)
        parts[points.original[k]] = points.parts[k];
    std::ranges::transform(points.decided_weights, totals.weights, part_weights.begin(),
                           std::plus<>());
}

}  // namespace rrcb
