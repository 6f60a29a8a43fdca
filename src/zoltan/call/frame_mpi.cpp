#include "zoltan/call/frame_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "zoltan/call/rcb_options.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rrcb::zoltan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds of the coordinates of all ranks, in a form that a maximum reduces.
struct Bounds {
    double dimension = 0;
    double minus_dimension = -max_dimension;
    double unusable = 0;  ///< 1: a coordinate is no number, or a rank has failed
    Vector minus_lower{-infinity, -infinity, -infinity};
    Vector upper{-infinity, -infinity, -infinity};

    bool can_be_flat() const {
        return dimension > 1 && dimension == -minus_dimension && unusable == 0;
    }
};

/// Collective.
Bounds bounds_of(const Points& points, const Participant& self) {
    Bounds bounds;
    bounds.dimension = points.dimension;
    bounds.minus_dimension = -points.dimension;
    const Box box = bounding_box(points);
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
        if (std::isnan(box.lower[a])) bounds.unusable = 1;
        bounds.minus_lower[a] = -box.lower[a];
        bounds.upper[a] = box.upper[a];
    }
    if (self.failed() || bounds.unusable != 0) {
        bounds.unusable = 1;
        bounds.minus_lower = bounds.upper = Vector{};
    }
    static_assert(sizeof(Bounds) == 9 * sizeof(double));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &bounds, 9, MPI_DOUBLE, MPI_MAX, self.comm),
               "MPI_Allreduce");
    return bounds;
}

/// Count, mean and second central moments, in units that bring every coordinate into [-1, 1].
struct Spread {
    double count = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();

    /// Chan, Golub and LeVeque (1979), their formula for two groups.
    void add(const Spread& other) {
        if (other.count == 0) return;
        const double all = count + other.count;
        const Eigen::Vector3d apart = other.mean - mean;
        moments += other.moments + (count * (other.count / all)) * (apart * apart.transpose());
        mean += (other.count / all) * apart;
        count = all;
    }
};

struct Unit {
    Vector centre{};
    double length = 0;

    Eigen::Vector3d scaled(const Points& points, LocalIndex i) const {
        Eigen::Vector3d u = Eigen::Vector3d::Zero();
        for (int a = 0; a < points.dimension; ++a)
            u[a] = (points.coordinate(i, a) - centre[static_cast<std::size_t>(a)]) / length;
        return u;
    }
};

Unit unit_of(const Bounds& bounds) {
    Unit unit;
    for (std::size_t a = 0; a < static_cast<std::size_t>(bounds.dimension); ++a) {
        unit.centre[a] = bounds.upper[a] / 2 - bounds.minus_lower[a] / 2;
        unit.length = std::max(unit.length, bounds.upper[a] / 2 + bounds.minus_lower[a] / 2);
    }
    return unit;
}

Spread spread_of(const Points& points, const Unit& unit) {
    Spread spread;
    if (points.count == 0) return spread;
    spread.count = static_cast<double>(points.count);
    for (LocalIndex i = 0; i < points.count; ++i) spread.mean += unit.scaled(points, i);
    spread.mean /= spread.count;
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Eigen::Vector3d apart = unit.scaled(points, i) - spread.mean;
        spread.moments += apart * apart.transpose();
    }
    return spread;
}

/// Matrix whose columns are the principal axes. The largest entry of each is positive.
template <int dimension>
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& moments) {
    const Eigen::Matrix<double, dimension, dimension> used =
        moments.topLeftCorner<dimension, dimension>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dimension, dimension>> solver(used);
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    axes.topLeftCorner<dimension, dimension>() = solver.eigenvectors();
    for (int k = 0; k < dimension; ++k) {
        Eigen::Index largest = 0;
        axes.col(k).cwiseAbs().maxCoeff(&largest);
        if (axes(largest, k) < 0) axes.col(k) *= -1;
    }
    return axes;
}

/// Frame of all axes, in no order. Where all are near to coordinate axes, as Zoltan takes it, it
/// picks these.
Frame frame_of(const Eigen::Matrix3d& axes, const Unit& unit, int dimension) {
    constexpr double near_one = 0.9999;
    Frame frame{dimension, dimension, {-1, -1, -1}, unit.centre, {}};
    bool aligned = true;
    for (int k = 0; k < dimension; ++k) {
        Eigen::Index largest = 0;
        aligned = aligned && axes.col(k).cwiseAbs().maxCoeff(&largest) >= near_one;
        frame.picked[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(largest);
        for (int j = 0; j < dimension; ++j)
            frame.axes[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)] = axes(j, k);
    }
    if (aligned) {
        frame.origin = Vector{};
        frame.axes = {};
    } else {
        frame.picked = {-1, -1, -1};
    }
    return frame;
}

/// Principal frame of the points of all ranks. Collective.
///
/// The root merges the moments in the order of the ranks: the bits do not depend on MPI's order.
Frame principal_frame(const Points& points, const Unit& unit, Participant& self) {
    std::vector<Spread> spreads;
    const bool is_root = mpi::rank_of(self.comm) == root;
    self.attempt([&] {
        if (is_root) spreads.resize(static_cast<std::size_t>(mpi::size_of(self.comm)));
    });
    agree(self);
    const Spread mine = spread_of(points, unit);
    mpi::check(MPI_Gather(&mine, sizeof(Spread), MPI_BYTE, spreads.data(), sizeof(Spread), MPI_BYTE,
                          root, self.comm),
               "MPI_Gather");
    Frame frame;
    if (is_root) {
        Spread all;
        for (const Spread& spread : spreads) all.add(spread);
        const Eigen::Matrix3d axes =
            points.dimension == 2 ? principal_axes<2>(all.moments) : principal_axes<3>(all.moments);
        frame = frame_of(axes, unit, points.dimension);
    }
    mpi::check(MPI_Bcast(&frame, sizeof(Frame), MPI_BYTE, root, self.comm), "MPI_Bcast");
    return frame;
}

/// Extents along all axes of a frame over all ranks. Collective.
Vector extents_along(const Frame& frame, const Points& points, MPI_Comm comm) {
    std::array<Vector, 2> ends;  // minus the lower, and the upper
    for (Vector& end : ends) end.fill(-infinity);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector position = points.position(i);
        for (std::size_t a = 0; a < static_cast<std::size_t>(frame.dimension); ++a) {
            const double x = coordinate_along(frame, static_cast<int>(a), position.data());
            ends[0][a] = std::max(ends[0][a], -x);
            ends[1][a] = std::max(ends[1][a], x);
        }
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &ends, 6, MPI_DOUBLE, MPI_MAX, comm), "MPI_Allreduce");
    Vector extents{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(frame.dimension); ++a)
        extents[a] = ends[0][a] + ends[1][a];
    return extents;
}

bool is_long(const Vector& extents, std::size_t axis, double ratio) {
    return extents[axis] >= std::ranges::max(extents) / ratio;
}

/// Frame with its longest axes first and the thin ones left out. Without axes where all are long.
Frame drop_thin_axes(const Frame& frame, const Vector& extents, double ratio) {
    if (!std::isfinite(std::ranges::max(extents))) return {};
    std::array<std::size_t, max_dimension> order{0, 1, 2};
    const auto dimension = static_cast<std::size_t>(frame.dimension);
    for (std::size_t k = 1; k < dimension; ++k)
        for (std::size_t j = k; j > 0 && extents[order[j]] > extents[order[j - 1]]; --j)
            std::swap(order[j], order[j - 1]);
    Frame chosen = frame;
    chosen.num_axes = 0;
    for (std::size_t k = 0; k < dimension; ++k) {
        chosen.picked[k] = frame.picked[order[k]];
        chosen.axes[k] = frame.axes[order[k]];
        if (is_long(extents, order[k], ratio)) ++chosen.num_axes;
    }
    return chosen.num_axes == frame.dimension ? Frame{} : chosen;
}

/// Whether the long axes of a frame are long still, and the others thin. Collective.
bool is_as_flat(const Frame& frame, const Points& points, double ratio, MPI_Comm comm) {
    const Vector extents = extents_along(frame, points, comm);
    bool same = std::isfinite(std::ranges::max(extents));
    for (std::size_t a = 0; a < static_cast<std::size_t>(frame.dimension); ++a)
        same = same && is_long(extents, a, ratio) == (static_cast<int>(a) < frame.num_axes);
    return same;
}

}  // namespace

Frame choose_frame(const Points& points, double ratio, const Frame* previous, Participant& self) {
    const Bounds bounds = bounds_of(points, self);
    if (!bounds.can_be_flat()) return {};
    const Unit unit = unit_of(bounds);
    if (!(unit.length > 0)) return {};
    if (previous != nullptr) {
        Frame frame = *previous;
        mpi::check(MPI_Bcast(&frame, sizeof(Frame), MPI_BYTE, root, self.comm), "MPI_Bcast");
        const bool fits = frame.turns() && frame.dimension == points.dimension;
        if (fits && is_as_flat(frame, points, ratio, self.comm)) return frame;
    }
    const Frame all = principal_frame(points, unit, self);
    return drop_thin_axes(all, extents_along(all, points, self.comm), ratio);
}

Flattened flatten(const Points& points, const Parameters& parameters, const Frame* previous,
                  Scratch<double>& room, Participant& self) {
    Flattened flat{{}, points};
    if (parameters.reduce_dimensions == 0) return flat;
    flat.frame = choose_frame(points, degenerate_ratio(parameters), previous, self);
    if (!flat.frame.turns()) return flat;
    flat.points = interleaved_points({}, flat.frame.num_axes);
    self.attempt([&] { flat.points = place(flat.frame, points, room); });
    return flat;
}

}  // namespace rrcb::zoltan
