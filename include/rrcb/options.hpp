#pragma once

#include <rrcb/stages.hpp>

#include <cstdint>
#include <vector>

namespace rrcb {

/// Accuracy to which the estimated cuts are moved by what the ranks really hold.
enum class Refine {
    none,       ///< not at all: the estimate from the statistics stands
    tolerance,  ///< until the measured imbalance is within `imbalance_tolerance`
    exact       ///< to the weighted median: each cut within the weight of one object, which goes
                ///< to the side that it takes the least beyond its size
};

/// What becomes of points in one and the same place where the balance asked for divides them.
enum class Coincident {
    together,  ///< they share a part, so that the part of a position is the part of its points
    divide     ///< some go to each side, those of lower ranks below; look-ups find one part
};

/// Cuts that each rank gets if many ranks make the parts, see Options::central_parts.
enum class HeldCuts {
    whole,  ///< all, so that look-ups work on every rank: two reductions, 40 bytes a part together
    own     ///< those above its points and its parts, see Cuts::nodes: no memory for each part
};

/// Lines of a grid across an axis: at origin + k * spacing for whole numbers k, as doubles compute
/// it, the product first.
struct GridLines {
    double origin = 0;   ///< of line 0
    double spacing = 0;  ///< > 0 and finite
};

/// Options of `balance`; must be the same on every rank, which is checked.
struct Options {
    int num_parts = 0;               ///< parts to make; 0: one per rank
    std::vector<double> part_sizes;  ///< relative weight of each part, >= 0, some > 0; empty: equal

    int support_mesh = 0;  ///< cells per axis of each rank's support mesh, up to 4096, in
                           ///< 3-D 256; 0: by its points

    Refine refine = Refine::tolerance;  ///< accuracy of the cuts
    double imbalance_tolerance = 1.01;  ///< tolerance: heaviest part / mean part to reach, >= 1,
                                        ///< finite

    std::vector<int> grouped_axes;  ///< cross all of the first axis' cuts, then the next axis',
                                    ///< ...; empty: each box across its own longest axis
    std::vector<int> cut_axes;      ///< axis of each cut in the order of Cuts::tree; empty: free
    bool plain_cuts = false;        ///< planes only: points on a plane stay together

    /// Least extent of every part along each axis, > 0 and finite, one per axis of the points;
    /// empty: any. Between two cuts `upper - lower >= min_width` holds as doubles compute it. On a
    /// side without a cut the extent counts to the bounding box of all points of the call; along an
    /// axis that is not cut there is nothing to keep. Parts of size 0 have no extent.
    std::vector<double> min_width;
    /// Cuts on these lines only, one entry per axis of the points; empty: anywhere. Such cuts are
    /// plain; each part holds one cell of the grid at least. With min_width as well both hold.
    std::vector<GridLines> grid;

    /// Only where cuts are refined and not plain.
    Coincident coincident = Coincident::together;

    /// Parts that rank 0 makes alone, at least 2. Where there are more, and more ranks, it makes
    /// regions, up to 64 and a power of two, and each cut below them is found by a rank of its
    /// parts; with Refine::exact, and once more if the tolerance is missed, each cut is. No effect
    /// with Refine::none, `min_width`, `grid` or `grouped_axes`.
    int central_parts = 4096;
    HeldCuts cuts = HeldCuts::whole;  ///< that each rank gets where many ranks make the parts

    StageObserver* observer = nullptr;  ///< of this rank alone, not compared; borrowed for the call
};

}  // namespace rrcb
