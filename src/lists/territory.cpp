#include "lists/territory.hpp"

#include "collective/communicator.hpp"
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

bool contains(const Box& box, const Vector& position, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (!(position[a] >= box.lower[a] && position[a] <= box.upper[a])) return false;
    return true;
}

}  // namespace

Territory::Territory(const Cuts& cuts, const NeighbourOptions& options, int rank, int num_ranks)
    : has_ranks_(options.ranks_of_parts.has_value()),
      rank_(rank),
      num_ranks_(num_ranks),
      reach_(std::max(options.cutoff, options.travel)) {
    check_tree(cuts);
    cuts_ = cuts;
    check(options);
    tree_ = PackedTree(cuts_);
    find_regions();
    std::vector<Box> homes = near_boxes(nullptr).homes();
    for (std::size_t k = 0; k < ends_.size(); ++k)
        if (ranks_of_end(ends_[k]).count > 1) homes.push_back(regions_[k]);
    inside_.emplace(homes, 0, dimension());
}

Territory::Territory(std::span<const Box> boxes, int dimension, const NeighbourOptions& options,
                     int rank, int num_ranks)
    : boxes_(boxes.begin(), boxes.end()),
      has_ranks_(options.ranks_of_parts.has_value()),
      rank_(rank),
      num_ranks_(num_ranks),
      reach_(std::max(options.cutoff, options.travel)) {
    require(!boxes.empty(), "give a box for each part, one of each rank or more");
    require(dimension >= 1 && dimension <= max_dimension, "dimension must be 1, 2 or 3");
    for (const Box& box : boxes)
        for (int a = 0; a < dimension; ++a)
            require(!std::isnan(box.lower[a]) && !std::isnan(box.upper[a]),
                    "bounds of boxes must not be NaN");
    cuts_.dimension = dimension;
    cuts_.num_parts = mpi::to_int(std::ssize(boxes));
    check(options);
    find_regions();
    const NearBoxes list = near_boxes(nullptr);
    for (const NearBoxes::Row& row : list.rows()) near_parts_.push_back(row.end);
    inside_.emplace(regions_, 0, dimension);
}

/// Checks the options, and takes ranks of parts and images.
void Territory::check(const NeighbourOptions& options) {
    require(is_distance(options.cutoff) && is_distance(options.travel),
            "cutoff and travel must be finite, 0 or more");
    require(options.needs >= Needs::scatter && options.needs <= Needs::symmetric,
            "needs must be scatter, gather or symmetric");
    if (has_ranks_) {
        ranks_of_parts_.assign(options.ranks_of_parts->begin(), options.ranks_of_parts->end());
        require(ranks_of_parts_.size() == static_cast<std::size_t>(num_parts()),
                "ranks_of_parts must have one entry for each part");
        check_ranks(ranks_of_parts_, num_ranks_);
    }
    if (options.periodic) images_.emplace(*options.periodic, dimension());
    if (images_) images_->check(reach_);
}

RankRange Territory::ranks_of_end(Part end) const {
    const Part part = cuts_.part_at(end);
    return has_ranks_ ? ranks_of_parts_[part] : ranks_of_part(part, cuts_.num_parts, num_ranks_);
}

void Territory::find_regions() {
    for (Part end = 0; end < cuts_.num_parts; ++end) {
        if (!ranks_of_end(end).contains(rank_)) continue;
        if (!boxes_.empty()) {
            add_region(end, boxes_[static_cast<std::size_t>(end)]);
            continue;
        }
        const Box region = region_of(cuts_, end);
        if (!is_region_empty(cuts_, end, region)) add_region(end, region);
    }
}

void Territory::add_region(Part end, const Box& region) {
    const Box box = images_ ? common(region, images_->box()) : region;
    if (!boxes_.empty() && is_empty(box, dimension())) return;
    ends_.push_back(end);
    regions_.push_back(box);
    for (std::size_t a = 0; a < max_dimension; ++a) {
        all_.lower[a] = std::min(all_.lower[a], box.lower[a]);
        all_.upper[a] = std::max(all_.upper[a], box.upper[a]);
    }
}

std::vector<int> Territory::near_ranks() const {
    std::vector<int> ranks;
    for (const Box& region : regions_) {
        const NearBoxes list = near(region, nullptr);
        ranks.insert(ranks.end(), list.ranks().begin(), list.ranks().end());
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
    return near(all_, reaches);
}

NearBoxes Territory::near(const Box& points, const PartReaches* reaches) const {
    const NearRequest request{
        [&](Part end) { return ranks_of_end(end); }, rank_, points, reach_, images(), reaches};
    return boxes_.empty() ? NearBoxes(cuts_, request) : NearBoxes(boxes_, dimension(), request);
}

/// Returns the end of the tree, or the first box of this rank, that contains a position; no_part if
/// none of these does.
Part Territory::end_at(const Vector& position) const {
    if (boxes_.empty())
        return tree_.entries()[static_cast<std::size_t>(tree_.end_of(position.data()))];
    for (std::size_t k = 0; k < ends_.size(); ++k)
        if (contains(regions_[k], position, dimension())) return ends_[k];
    return no_part;
}

/// A box of this rank comes first, then the first one near, then any, for the text of an error.
int Territory::owner_by_boxes(const Vector& position) const {
    if (end_at(position) != no_part) return rank_;
    const auto holds = [&](Part part) {
        return contains(boxes_[static_cast<std::size_t>(part)], position, dimension());
    };
    Part part = 0;
    const auto near = std::ranges::find_if(near_parts_, holds);
    if (near != near_parts_.end())
        part = *near;
    else
        while (part < num_parts() && !holds(part)) ++part;
    if (part == num_parts()) return -1;
    const RankRange ranks = ranks_of_end(part);
    return ranks.first_rank + rank_ % ranks.count;
}

int Territory::owner_of(const Vector& position) const {
    if (!boxes_.empty()) return owner_by_boxes(position);
    const RankRange ranks = ranks_of_end(end_at(position));
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
        const Part end = end_at(x);
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
    return std::ranges::any_of(
        regions_, [&](const Box& box) { return contains(box, position, dimension()); });
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
