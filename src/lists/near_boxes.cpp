#include "lists/near_boxes.hpp"

#include "arithmetic/infinity.hpp"
#include "cuts/tree.hpp"
#include "lists/part_reaches.hpp"
#include "lists/periodic_images.hpp"

#include <algorithm>
#include <array>

namespace rrcb {

namespace {

/// Fewer rows get no common row, and are tested one by one.
constexpr std::size_t least_rows_below = 8;

/// Intervals along one axis that contain the points or their images.
using Intervals = std::vector<std::array<double, 2>>;

Box joined(const Box& a, const Box& b) {
    Box box;
    for (std::size_t axis = 0; axis < max_dimension; ++axis) {
        box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
        box.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
    }
    return box;
}

}  // namespace

Box common(const Box& a, const Box& b) {
    Box box;
    for (std::size_t axis = 0; axis < max_dimension; ++axis) {
        box.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
        box.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
    }
    return box;
}

bool is_empty(const Box& box, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (!(box.lower[a] <= box.upper[a])) return true;
    return false;
}

/// Builds the list of NearBoxes.
class NearList {
  public:
    NearList(int dimension, const NearRequest& request, NearBoxes& list)
        : dimension_(dimension),
          request_(request),
          list_(list),
          reach_(Ball::reach_of(request.radius)) {
        if (request.reaches != nullptr)
            reach_ = std::max(reach_, Ball::reach_of(request.reaches->greatest()));
        for (int a = 0; a < dimension; ++a) {
            const std::array ends{request.points.lower[a], request.points.upper[a]};
            if (request.images != nullptr) {
                request.images->for_each_along(a, ends, reach_, [&](double lower, double upper) {
                    places_[a].push_back({lower, upper});
                });
            } else {
                places_[a].push_back(ends);
            }
        }
    }

    void make(const Cuts& cuts) {
        const Box all = limits();
        if (add(cuts, root_of(cuts), all)) list_.homes_.push_back(all);
        number_ranks();
    }

    void make(std::span<const Box> boxes) {
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            const Box box = common(boxes[k], limits());
            if (is_empty(box, dimension_) || !is_near(box)) continue;
            if (add_end(static_cast<Part>(k), box)) list_.homes_.push_back(box);
        }
        std::erase_if(list_.homes_, [&](const Box& home) {
            return std::ranges::any_of(list_.rows_, [&](const NearBoxes::Row& row) {
                return !is_home(request_.ranks_of(row.end)) && overlaps(row.box, home);
            });
        });
        number_ranks();
    }

  private:
    Box limits() const { return request_.images != nullptr ? request_.images->box() : everywhere; }

    bool is_home(const RankRange& ranks) const {
        return ranks.first_rank == request_.rank && ranks.count == 1;
    }

    /// Returns whether a closed box reaches into the interior of another.
    bool overlaps(const Box& box, const Box& other) const {
        for (int a = 0; a < dimension_; ++a)
            if (!(box.lower[a] < other.upper[a] && box.upper[a] > other.lower[a])) return false;
        return true;
    }

    /// Gives the ranks of the rows consecutive slots.
    void number_ranks() {
        for (const NearBoxes::Row& row : list_.rows_)
            for (int k = 0; k < row.num_slots; ++k) list_.ranks_.push_back(row.first_slot + k);
        std::ranges::sort(list_.ranks_);
        list_.ranks_.erase(std::ranges::unique(list_.ranks_).begin(), list_.ranks_.end());
        for (NearBoxes::Row& row : list_.rows_)
            row.first_slot = static_cast<std::int32_t>(
                std::ranges::lower_bound(list_.ranks_, row.first_slot) - list_.ranks_.begin());
    }

    /// Adds the regions at or below a node, whose box is given. Returns true if only this rank
    /// holds all of them.
    bool add(const Cuts& cuts, const Descent& at, const Box& box) {
        if (!is_near(box)) return false;
        // A part without any position needs no ghosts.
        if (at.is_part())
            return is_region_empty(cuts, at.first_part, box) || add_end(at.first_part, box);
        const Cut& cut = cuts.tree[at.node];
        const std::size_t first = list_.rows_.size();
        list_.rows_.emplace_back();
        const Box below = box_below(box, cut);
        const Box above = box_above(box, cut);
        const bool is_lower_home = add(cuts, at.lower(), below);
        const bool is_upper_home = add(cuts, at.upper(), above);
        if (is_lower_home != is_upper_home) list_.homes_.push_back(is_lower_home ? below : above);
        join(first);
        return is_lower_home && is_upper_home;
    }

    bool add_end(Part end, const Box& box) {
        const RankRange ranks = request_.ranks_of(end);
        const bool is_only_here = is_home(ranks);
        if (is_only_here && request_.images == nullptr) return true;
        const double reach =
            request_.reaches != nullptr ? Ball::reach_of(request_.reaches->of(end)) : -infinity;
        // The slot is preliminarily the rank, until the list of all ranks is complete.
        list_.rows_.push_back({box, reach, end, 0, ranks.first_rank, ranks.count});
        return is_only_here;
    }

    /// If many rows follow `first`, makes `first` a common row for them; otherwise removes it.
    void join(std::size_t first) {
        std::vector<NearBoxes::Row>& rows = list_.rows_;
        const std::size_t num_below = rows.size() - first - 1;
        if (num_below < least_rows_below) {
            rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(first));
            return;
        }
        NearBoxes::Row row{{}, -infinity, no_part, static_cast<std::int32_t>(num_below)};
        for (std::size_t k = first + 1; k < rows.size(); ++k) {
            row.box = joined(row.box, rows[k].box);
            row.reach = std::max(row.reach, rows[k].reach);
        }
        rows[first] = row;
    }

    bool is_near(const Box& box) const {
        for (int a = 0; a < dimension_; ++a)
            if (std::ranges::none_of(places_[a], [&](const auto& place) {
                    return box.lower[a] - place[1] <= reach_ && place[0] - box.upper[a] <= reach_;
                }))
                return false;
        return true;
    }

    int dimension_;
    const NearRequest& request_;
    NearBoxes& list_;
    double reach_;  ///< largest reach of all points
    std::array<Intervals, max_dimension> places_{};
};

NearBoxes::NearBoxes(const Cuts& cuts, const NearRequest& request) {
    if (!is_empty(request.points, 1)) NearList(cuts.dimension, request, *this).make(cuts);
}

NearBoxes::NearBoxes(std::span<const Box> boxes, int dimension, const NearRequest& request) {
    if (!is_empty(request.points, 1)) NearList(dimension, request, *this).make(boxes);
}

}  // namespace rrcb
