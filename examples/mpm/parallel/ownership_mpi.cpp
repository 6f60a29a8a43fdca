#include "parallel/ownership_mpi.hpp"

#include "parallel/communicator_mpi.hpp"
#include "particles/vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

/// Returns an error message about a point whose position is not finite.
std::string text_of(double id, Positions positions, std::size_t p, double now) {
    std::ostringstream text;
    text << "point " << std::setprecision(15) << id << std::setprecision(6)
         << " has no finite position: x = " << positions.x[p] << " m, y = " << positions.y[p]
         << " m";
    if (positions.dimension == 3) text << ", z = " << positions.z[p] << " m";
    text << ", time = " << now << " s: lower the Courant number";
    return text.str();
}

bool is_open(const Wall& wall) {
    return wall.kind == Wall::open;
}

}  // namespace

Ownership::Ownership(const GridShape& grid, const Walls& walls, MPI_Comm comm)
    : comm_(comm),
      rank_(rank_of(comm)),
      num_ranks_(static_cast<std::size_t>(size_of(comm))),
      grid_{grid.lower, grid.upper()},
      is_open_{{{is_open(walls.left), is_open(walls.right)},
                {is_open(walls.bottom), is_open(walls.top)},
                {is_open(walls.back), is_open(walls.front)}}} {}

/// Returns whether a point is in the box along all axes.
template <int D>
bool is_inside(const Box& box, const std::array<const double*, 3>& at, std::size_t p) {
    for (std::size_t a = 0; a < D; ++a)
        if (!(at[a][p] >= box.lower[a] && at[a][p] <= box.upper[a])) return false;
    return true;
}

/// Returns whether all points of a block are in the box. Checks two points at a time.
template <int D>
bool are_inside(const Box& box, const std::array<const double*, 3>& at, std::size_t begin,
                std::size_t end) {
    PairMask inside = {-1, -1};
    std::array<Pair, D> lower, upper;
    for (std::size_t a = 0; a < D; ++a) {
        lower[a] = Pair{box.lower[a], box.lower[a]};
        upper[a] = Pair{box.upper[a], box.upper[a]};
    }
    std::size_t p = begin;
    for (; p + 2 <= end; p += 2)
        for (std::size_t a = 0; a < D; ++a) {
            const Pair here = load_pair(at[a] + p);
            inside &= (here >= lower[a]) & (here <= upper[a]);
        }
    return inside[0] && inside[1] && (p == end || is_inside<D>(box, at, p));
}

/// Returns whether a point beyond the side of the grid is kept, because a wall reflects it.
template <int D>
bool Ownership::stays(Particles& particles, const MotionColumns& motion, std::size_t p) const {
    bool stays = true;
    for (std::size_t a = 0; a < D; ++a) {
        double& at = particles.data(motion.position[a])[p];
        const std::array side{grid_.lower[a], grid_.upper[a]};
        const std::size_t end = at > side[1] ? 1 : 0;
        if (at >= side[0] && at <= side[1]) continue;
        stays = stays && !is_open_[a][end];
        particles.data(motion.velocity[a])[p] *= -1;
        at = std::clamp(2 * side[end] - at, side[0], side[1]);
    }
    return stays;
}

template <int D>
void Ownership::find_outside(const Box& box, const Box& home, Particles& particles,
                             const MotionColumns& motion, double now) {
    constexpr std::size_t block = 256;
    std::array<const double*, 3> at{};
    for (std::size_t a = 0; a < D; ++a) at[a] = particles[motion.position[a]].data();
    has_outgrown_ = false;
    for (std::size_t begin = 0; begin < particles.size(); begin += block) {
        const std::size_t end = std::min(begin + block, particles.size());
        if (are_inside<D>(home, at, begin, end)) continue;
        for (std::size_t p = begin; p < end; ++p) {
            for (std::size_t a = 0; a < D; ++a)
                if (!std::isfinite(at[a][p])) {
                    lost_ = text_of(particles[motion.id][p], positions_of(particles, motion, D), p,
                                    now);
                    return report(Fault::not_finite);
                }
            const bool is_lost = !is_inside<D>(grid_, at, p) && !stays<D>(particles, motion, p);
            if (!is_lost && is_inside<D>(box, at, p)) {
                has_outgrown_ = has_outgrown_ || !is_inside<D>(home, at, p);
                continue;
            }
            leavers_.points.push_back(p);
            leavers_.owners.push_back(is_lost ? nobody : rank_);
            for (std::size_t a = 0; a < D && !is_lost; ++a) at_[a].push_back(at[a][p]);
        }
    }
}

template <int D>
void Ownership::find_leavers(const Decomposition& decomposition, const Box& home,
                             Particles& particles, const MotionColumns& motion, double now,
                             std::span<const int> neighbours) {
    leavers_.points.clear();
    leavers_.owners.clear();
    for (std::vector<double>& column : at_) column.clear();
    const Box& box = decomposition.boxes[static_cast<std::size_t>(rank_)];
    find_outside<D>(box, home, particles, motion, now);
    const Positions at{at_[0], at_[1], at_[2]};
    if (at.x.empty() || !ask_owners(decomposition, at)) return;
    std::size_t k = 0;
    for (int& owner : leavers_.owners) {
        if (owner == nobody) continue;
        check_owner(decomposition, owners_[k], at, k);
        owner = owners_[k++];
    }
    measure_reach(neighbours);
}

void Ownership::find_reassigned(const Decomposition& next, Positions positions,
                                std::span<const int> neighbours) {
    leavers_.points.clear();
    leavers_.owners.clear();
    if (next.boxes.size() != num_ranks_) return report(Fault::no_owner);
    if (next.local_owners.empty() && !ask_owners(next, positions)) return;
    const std::vector<int>& owners = next.local_owners.empty() ? owners_ : next.local_owners;
    if (owners.size() != positions.size()) return report(Fault::no_owner);
    if (positions.dimension == 2)
        take_owners<2>(next, owners, positions);
    else
        take_owners<3>(next, owners, positions);
    measure_reach(neighbours);
}

/// Collects the points of other owners as leavers. Blocks without leavers are checked two points at
/// a time.
template <int D>
void Ownership::take_owners(const Decomposition& decomposition, std::span<const int> owners,
                            Positions positions) {
    constexpr std::size_t block = 256;
    const std::array<const double*, 3> at{positions.x.data(), positions.y.data(),
                                          positions.z.data()};
    const Box& mine = decomposition.boxes[static_cast<std::size_t>(rank_)];
    for (std::size_t begin = 0; begin < owners.size(); begin += block) {
        const std::size_t end = std::min(begin + block, owners.size());
        int differ = 0;
        for (std::size_t p = begin; p < end; ++p) differ |= owners[p] ^ rank_;
        if (differ == 0 && are_inside<D>(mine, at, begin, end)) continue;
        for (std::size_t p = begin; p < end; ++p) {
            check_owner(decomposition, owners[p], positions, p);
            if (owners[p] == rank_) continue;
            leavers_.points.push_back(p);
            leavers_.owners.push_back(owners[p]);
        }
    }
}

/// Reports an owner that does not exist, or whose box does not contain the point.
void Ownership::check_owner(const Decomposition& decomposition, int owner, Positions positions,
                            std::size_t point) {
    if (static_cast<std::size_t>(owner) >= num_ranks_)
        report(Fault::no_owner);
    else if (!contains(decomposition.boxes[static_cast<std::size_t>(owner)], positions[point]))
        report(Fault::misplaced);
}

void Ownership::measure_reach(std::span<const int> neighbours) {
    for (const int owner : leavers_.owners) {
        if (owner == nobody) continue;
        const bool near = std::ranges::binary_search(neighbours, owner);
        reach_ = std::max(reach_, near ? Reach::neighbours : Reach::anywhere);
    }
}

bool Ownership::ask_owners(const Decomposition& decomposition, Positions positions) {
    owners_.assign(positions.x.size(), -1);
    try {
        decomposition.owners(positions, owners_);
    } catch (const std::exception&) {
        report(Fault::no_owner);
        return false;
    }
    return true;
}

void Ownership::report(Fault fault) {
    fault_ = std::max(fault_, fault);
}

Agreement Ownership::agree(double speed) {
    std::array<double, 3> worst{static_cast<double>(fault_), static_cast<double>(reach_), speed};
    MPI_Allreduce(MPI_IN_PLACE, worst.data(), 3, MPI_DOUBLE, MPI_MAX, comm_);
    const auto fault = static_cast<Fault>(static_cast<int>(worst[0]));
    const bool is_mine = fault_ == fault;
    fault_ = Fault::none;
    reach_ = Reach::nowhere;
    if (fault != Fault::none) throw_fault(fault, is_mine);
    return {static_cast<Reach>(static_cast<int>(worst[1])), worst[2]};
}

void Ownership::throw_fault(Fault fault, bool is_mine) {
    if (fault == Fault::misplaced)
        throw std::runtime_error(
            "the decomposition gave a point to a rank whose box does not hold it");
    if (fault == Fault::not_finite) fail_together(is_mine ? lost_ : "", comm_);
    throw std::runtime_error(
        "the decomposition named no owner of some point: it must give one box per rank and a "
        "rank for every position in the grid");
}

template void Ownership::find_leavers<2>(const Decomposition&, const Box&, Particles&,
                                         const MotionColumns&, double, std::span<const int>);
template void Ownership::find_leavers<3>(const Decomposition&, const Box&, Particles&,
                                         const MotionColumns&, double, std::span<const int>);

}  // namespace mpm
