#include "parallel/ownership_mpi.hpp"

#include "parallel/communicator_mpi.hpp"
#include "particles/pair.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mpm {

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
void Ownership::find_outside(const Box& box, Positions positions, std::span<const double> ids) {
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
                lost_.id = ids[p];
                lost_.at = positions[p];
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
    lost_.time = now;
    leavers_.points.clear();
    for (std::vector<double>& column : at_) column.clear();
    const Box& box = decomposition.boxes[static_cast<std::size_t>(rank_)];
    is_solid_ = !positions.z.empty();
    if (!is_solid_)
        find_outside<2>(box, positions, ids);
    else
        find_outside<3>(box, positions, ids);
    leavers_.owners.resize(leavers_.points.size());
    if (leavers_.points.empty() || !ask_owners(decomposition, {at_[0], at_[1], at_[2]})) return;
    leavers_.owners.assign(owners_.begin(), owners_.end());
    for (const int owner : leavers_.owners) {
        const bool near = std::ranges::binary_search(neighbours, owner);
        reach_ = std::max(reach_, near ? Reach::neighbours : Reach::anywhere);
    }
}

void Ownership::find_reassigned(const Decomposition& next, Positions positions) {
    leavers_.points.clear();
    leavers_.owners.clear();
    if (next.boxes.size() != num_ranks_) return report(Fault::no_owner);
    if (next.local_owners.empty()) {
        if (!ask_owners(next, positions)) return;
    } else {
        owners_ = next.local_owners;
        if (!check_owners(next, positions)) return;
    }
    for (std::size_t p = 0; p < owners_.size(); ++p) {
        if (owners_[p] == rank_) continue;
        leavers_.points.push_back(p);
        leavers_.owners.push_back(owners_[p]);
        reach_ = Reach::anywhere;
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
    return check_owners(decomposition, positions);
}

bool Ownership::check_owners(const Decomposition& decomposition, Positions positions) {
    if (owners_.size() != positions.x.size()) {
        report(Fault::no_owner);
        return false;
    }
    for (std::size_t p = 0; p < owners_.size(); ++p) {
        const auto owner = static_cast<std::size_t>(owners_[p]);
        if (owner >= num_ranks_)
            report(Fault::no_owner);
        else if (!contains(decomposition.boxes[owner], positions[p]))
            report(Fault::misplaced);
    }
    return fault_ == Fault::none;
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
    if (fault == Fault::no_owner)
        throw std::runtime_error(
            "the decomposition named no owner of some point: it must give one box per rank and a "
            "rank for every position in the grid");
    throw_lost_point(is_mine);
}

/// Of several ranks that have lost a point, the lowest tells about it.
void Ownership::throw_lost_point(bool is_mine) {
    int teller = is_mine ? rank_ : static_cast<int>(num_ranks_);
    MPI_Allreduce(MPI_IN_PLACE, &teller, 1, MPI_INT, MPI_MIN, comm_);
    MPI_Bcast(&lost_, sizeof lost_ / sizeof(double), MPI_DOUBLE, teller, comm_);
    std::ostringstream text;
    text << "point " << std::setprecision(15) << lost_.id << std::setprecision(6)
         << " has left the grid at x = " << lost_.at[0] << " m, y = " << lost_.at[1] << " m";
    if (is_solid_) text << ", z = " << lost_.at[2] << " m";
    text << ", time = " << lost_.time
         << " s: make the grid larger, give it walls, or lower the Courant number";
    throw std::runtime_error(text.str());
}

}  // namespace mpm
