#include "parallel/ownership_mpi.hpp"

#include "parallel/communicator_mpi.hpp"
#include "particles/vectors.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

/// Text about a point that has left the grid.
std::string text_of(double id, Positions positions, std::size_t p, double now) {
    std::ostringstream text;
    text << "point " << std::setprecision(15) << id << std::setprecision(6)
         << " has left the grid at x = " << positions.x[p] << " m, y = " << positions.y[p] << " m";
    if (!positions.z.empty()) text << ", z = " << positions.z[p] << " m";
    text << ", time = " << now
         << " s: make the grid larger, give it walls, or lower the Courant number";
    return text.str();
}

}  // namespace

Ownership::Ownership(const GridShape& grid, MPI_Comm comm)
    : comm_(comm),
      rank_(rank_of(comm)),
      num_ranks_(static_cast<std::size_t>(size_of(comm))),
      grid_{grid.lower, grid.upper()} {}

/// Whether a point lies in the box along all axes.
template <int D>
bool is_inside(const Box& box, const std::array<const double*, 3>& at, std::size_t p) {
    for (std::size_t a = 0; a < D; ++a)
        if (!(at[a][p] >= box.lower[a] && at[a][p] <= box.upper[a])) return false;
    return true;
}

/// Whether all points of a block lie in the box, two at a time.
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

template <int D>
void Ownership::find_outside(const Box& box, Positions positions, std::span<const double> ids,
                             double now) {
    constexpr std::size_t block = 256;
    const std::array<const double*, 3> at{positions.x.data(), positions.y.data(),
                                          positions.z.data()};
    Box inner = box;
    for (std::size_t a = 0; a < D; ++a) {
        inner.lower[a] = std::max(box.lower[a], grid_.lower[a]);
        inner.upper[a] = std::min(box.upper[a], grid_.upper[a]);
    }
    for (std::size_t begin = 0; begin < positions.size(); begin += block) {
        const std::size_t end = std::min(begin + block, positions.size());
        if (are_inside<D>(inner, at, begin, end)) continue;
        for (std::size_t p = begin; p < end; ++p) {
            if (!is_inside<D>(grid_, at, p)) {
                lost_ = text_of(ids[p], positions, p, now);
                return report(Fault::left_grid);
            }
            if (is_inside<D>(box, at, p)) continue;
            leavers_.points.push_back(p);
            for (std::size_t a = 0; a < D; ++a) at_[a].push_back(at[a][p]);
        }
    }
}

void Ownership::find_leavers(const Decomposition& decomposition, Positions positions,
                             std::span<const double> ids, double now,
                             std::span<const int> neighbours) {
    leavers_.points.clear();
    for (std::vector<double>& column : at_) column.clear();
    const Box& box = decomposition.boxes[static_cast<std::size_t>(rank_)];
    if (positions.z.empty())
        find_outside<2>(box, positions, ids, now);
    else
        find_outside<3>(box, positions, ids, now);
    leavers_.owners.clear();
    if (leavers_.points.empty() || !ask_owners(decomposition, {at_[0], at_[1], at_[2]})) return;
    for (std::size_t k = 0; k < owners_.size(); ++k)
        check_owner(decomposition, owners_[k], {at_[0], at_[1], at_[2]}, k);
    leavers_.owners.assign(owners_.begin(), owners_.end());
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
    if (positions.z.empty())
        take_owners<2>(next, owners, positions);
    else
        take_owners<3>(next, owners, positions);
    measure_reach(neighbours);
}

/// Takes the points of other owners as leavers. Blocks of points that stay are checked two points
/// at a time.
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

/// Reports an owner that does not exist or whose box does not hold the point.
void Ownership::check_owner(const Decomposition& decomposition, int owner, Positions positions,
                            std::size_t point) {
    if (static_cast<std::size_t>(owner) >= num_ranks_)
        report(Fault::no_owner);
    else if (!contains(decomposition.boxes[static_cast<std::size_t>(owner)], positions[point]))
        report(Fault::misplaced);
}

void Ownership::measure_reach(std::span<const int> neighbours) {
    for (const int owner : leavers_.owners) {
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
    if (fault == Fault::left_grid) fail_together(is_mine ? lost_ : "", comm_);
    throw std::runtime_error(
        "the decomposition named no owner of some point: it must give one box per rank and a "
        "rank for every position in the grid");
}

}  // namespace mpm
