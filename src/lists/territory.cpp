#include "lists/territory.hpp"

#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace rrcb {

namespace {

bool is_distance(double distance) {
    return std::isfinite(distance) && distance >= 0;
}

Box common(const Box& a, const Box& b) {
    Box box;
    for (std::size_t axis = 0; axis < max_dimension; ++axis) {
        box.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
        box.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
    }
    return box;
}

}  // namespace

Territory::Territory(const Cuts& cuts, const NeighbourOptions& options, int rank, int num_ranks)
    : has_ranks_(options.ranks_of_parts.has_value()),
      rank_(rank),
      num_ranks_(num_ranks),
      reach_(std::max(options.cutoff, options.travel)) {
    check_tree(cuts);
    require(is_distance(options.cutoff) && is_distance(options.travel),
            "cutoff and travel must be finite, 0 or more");
    require(options.needs >= Needs::scatter && options.needs <= Needs::symmetric,
            "needs must be scatter, gather or symmetric");
    if (has_ranks_) {
        ranks_of_parts_.assign(options.ranks_of_parts->begin(), options.ranks_of_parts->end());
        require(ranks_of_parts_.size() == static_cast<std::size_t>(cuts.num_parts),
                "ranks_of_parts must have one entry for each part");
        check_ranks(ranks_of_parts_, num_ranks);
    }
    if (options.periodic) images_.emplace(*options.periodic, cuts.dimension);
    if (images_) images_->check(reach_);
    cuts_ = cuts;
    tree_ = PackedTree(cuts_);
    find_regions();
    std::vector<Box> homes = near_boxes(nullptr).homes();
    for (std::size_t k = 0; k < ends_.size(); ++k)
        if (ranks_of_end(ends_[k]).count > 1) homes.push_back(regions_[k]);
    inside_.emplace(homes, 0, cuts_.dimension);
}

RankRange Territory::ranks_of_end(Part end) const {
    const Part part = cuts_.part_at(end);
    return has_ranks_ ? ranks_of_parts_[part] : ranks_of_part(part, cuts_.num_parts, num_ranks_);
}

void Territory::find_regions() {
    for (Part end = 0; end < cuts_.num_parts; ++end) {
        if (!ranks_of_end(end).contains(rank_)) continue;
        const Box region = region_of(cuts_, end);
        if (is_region_empty(cuts_, end, region)) continue;
        ends_.push_back(end);
        regions_.push_back(images_ ? common(region, images_->box()) : region);
        for (std::size_t a = 0; a < max_dimension; ++a) {
            all_.lower[a] = std::min(all_.lower[a], regions_.back().lower[a]);
            all_.upper[a] = std::max(all_.upper[a], regions_.back().upper[a]);
        }
    }
}

std::vector<int> Territory::near_ranks() const {
    std::vector<int> ranks;
    const auto ranks_of = [&](Part end) { return ranks_of_end(end); };
    for (const Box& region : regions_) {
        const NearBoxes near(cuts_, {ranks_of, rank_, region, reach_, images()});
        ranks.insert(ranks.end(), near.ranks().begin(), near.ranks().end());
    }
    // A rank without regions gets the ranks before and after it as neighbours, so that errors still
    // reach all ranks; see Neighbours.
    if (regions_.empty() && rank_ > 0) ranks.push_back(rank_ - 1);
    if (regions_.empty() && rank_ + 1 < num_ranks_) ranks.push_back(rank_ + 1);
    std::ranges::sort(ranks);
    ranks.erase(std::ranges::unique(ranks).begin(), ranks.end());
    std::erase(ranks, rank_);
    return ranks;
}

NearBoxes Territory::near_boxes(const PartReaches* reaches) const {
    return NearBoxes(cuts_, {[&](Part end) { return ranks_of_end(end); }, rank_, all_, reach_,
                             images(), reaches});
}

int Territory::owner_of(const Vector& position) const {
    const Part end = tree_.entries()[static_cast<std::size_t>(tree_.end_of(position.data()))];
    const RankRange ranks = ranks_of_end(end);
    if (ranks.contains(rank_)) return rank_;
    // If a cut divides coincident points, those at this position may be on either side.
    bool is_here = false;
    tree_.visit_touching({position, position},
                         [&](Part other) { is_here |= ranks_of_end(other).contains(rank_); });
    return is_here ? rank_ : ranks.first_rank + rank_ % ranks.count;
}

void Territory::note_reaches(const Points& points, const Radii& radii, PartReaches& reaches) const {
    const auto for_each_end = [&](LocalIndex i, auto&& visit) {
        const Vector x = points.position(i);
        const Part end = tree_.entries()[static_cast<std::size_t>(tree_.end_of(x.data()))];
        if (std::ranges::binary_search(ends_, end)) return visit(end);
        std::ranges::for_each(ends_, visit);
    };
    for (LocalIndex i = 0; i < points.count; ++i)
        for_each_end(i, [&](Part end) { reaches.note_radius(end, radii.of(i)); });
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector x = points.position(i);
        for_each_end(i, [&](Part end) { reaches.note_box(end, radii.of(i), {x, x}); });
    }
}

bool Territory::is_at_home(const Vector& position) const {
    return std::ranges::any_of(regions_, [&](const Box& box) {
        bool is_inside = true;
        for (int a = 0; a < cuts_.dimension; ++a)
            is_inside = is_inside && position[a] >= box.lower[a] && position[a] <= box.upper[a];
        return is_inside;
    });
}

bool Territory::is_within_reach(const Vector& position, double radius) const {
    const Ball ball(position, reach_ - radius);
    return std::ranges::any_of(
        regions_, [&](const Box& box) { return ball.touches(box, -infinity, cuts_.dimension); });
}

void Territory::check_position(const Points& points, LocalIndex point) const {
    const Vector x = points.position(point);
    for (int a = 0; a < points.dimension; ++a) {
        if (!std::isfinite(x[a])) reject(name_of(points, point) + " is NaN or infinite");
        if (images_ && !(x[a] >= images_->box().lower[a] && x[a] <= images_->box().upper[a]))
            reject(name_of(points, point) + " is outside the periodic box along axis " +
                   std::to_string(a) + "; wrap positions before");
    }
}

std::string Territory::name_of(const Points& points, LocalIndex point) const {
    std::string text = "point " + std::to_string(point) + " (the first is 0) at (";
    for (int a = 0; a < points.dimension; ++a) {
        char number[32];
        char* const end =
            std::to_chars(std::begin(number), std::end(number), points.coordinate(point, a)).ptr;
        text.append(a == 0 ? "" : ", ").append(&number[0], end);
    }
    return text + ')';
}

}  // namespace rrcb
