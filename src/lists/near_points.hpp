#pragma once

#include "lists/near_boxes.hpp"
#include "lists/part_reaches.hpp"
#include "lists/periodic_images.hpp"
#include "lists/quiet_boxes.hpp"
#include "lists/radii.hpp"
#include "lists/rank_lists.hpp"

#include <type_traits>

namespace rrcb {

/// Lists the points that other ranks need because of the regions of their parts.
struct NearPoints {
    const Points& points;
    const Radii& radii;
    const NearBoxes& near;
    const PeriodicImages* images;  ///< images of a periodic box, or null
    const PartReaches* reaches;    ///< reaches of all near parts if these count, or null
    int rank;                      ///< number of this rank, which needs only images of its points
    RankLists& lists;
    double reach = reaches != nullptr ? reaches->greatest() : -infinity;

    /// Calls check(i, position) for each point outside the quiet boxes, before it is listed.
    template <class Check>
    void list(const QuietBoxes& quiet, Check&& check) {
        const auto list_in = [&](auto dimension) {
            quiet.for_each_outside(points, [&](LocalIndex i) {
                const Vector x = points.position(i);
                check(i, x);
                add<dimension>(i, x);
            });
        };
        if (points.dimension == 1) return list_in(std::integral_constant<int, 1>{});
        if (points.dimension == 2) return list_in(std::integral_constant<int, 2>{});
        list_in(std::integral_constant<int, 3>{});
    }

  private:
    template <int dimension>
    void add(LocalIndex point, const Vector& position) {
        const Ball ball(position, radii.of_sender(point));
        if (images == nullptr) return add<dimension>(point, ball, Shift{});
        images->for_each(ball.widened(reach), [&](const Shift& shift, const Vector& centre) {
            add<dimension>(point, ball.moved_to(centre), shift);
        });
    }

    template <int dimension>
    void add(LocalIndex point, const Ball& ball, const Shift& shift) {
        const bool is_image = shift != Shift{};
        lists.begin(point, shift);
        near.for_each_touched<dimension>(ball, [&](const NearBoxes::Row& row) {
            if (reaches != nullptr && !reaches->reaches(row.end, ball)) return;
            for (std::int32_t slot = row.first_slot; slot < row.first_slot + row.num_slots; ++slot)
                if (is_image || lists.rank_of(slot) != rank) lists.add(slot);
        });
    }
};

}  // namespace rrcb
