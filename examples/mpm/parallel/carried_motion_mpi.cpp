#include "parallel/carried_motion_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

constexpr int motion_tag = 4;

template <int D>
bool holds(const NodeRange<D>& range, const std::array<int, D>& node) {
    for (std::size_t a = 0; a < D; ++a)
        if (node[a] < range.begin[a] || node[a] >= range.begin[a] + range.count[a]) return false;
    return true;
}

/// Calls visit(node) for the nodes that rank `to` gains and rank `from`, as the lowest, hands on.
template <int D, typename Visit>
void visit_gained(std::span<const NodeRange<D>> before, std::span<const NodeRange<D>> after,
                  std::size_t from, std::size_t to, Visit visit) {
    const NodeRange<D> shared = intersection<D>(before[from], after[to]);
    if (shared.empty() || intersection<D>(shared, before[to]) == shared) return;
    visit_nodes<D>(shared, [&](const std::array<int, D>& node) {
        if (holds<D>(before[to], node)) return;
        for (std::size_t lower = 0; lower < from; ++lower)
            if (holds<D>(before[lower], node)) return;
        visit(node);
    });
}

template <int D>
GridPatch<D> numbering_of(const NodeRange<D>& nodes) {
    GridPatch<D> numbering;
    numbering.nodes = nodes;
    return numbering;
}

}  // namespace

template <int D>
void carry_motion(std::span<const NodeRange<D>> before, std::span<const NodeRange<D>> after,
                  std::span<const NodeMotion<D>> last, GridPatch<D>& patch, MPI_Comm comm) {
    static_assert(sizeof(NodeMotion<D>) == 3 * D * sizeof(double));
    const auto me = static_cast<std::size_t>(rank_of(comm)), num_ranks = before.size();
    const GridPatch<D> old = numbering_of<D>(before[me]);
    std::vector<std::vector<NodeMotion<D>>> outgoing(num_ranks), incoming(num_ranks);
    std::vector<MPI_Request> requests;
    const auto length_of = [](const auto& message) {
        return static_cast<int>(message.size() * 3 * D);
    };
    for (std::size_t rank = 0; rank < num_ranks; ++rank) {
        if (rank == me) continue;
        visit_gained<D>(before, after, rank, me,
                        [&](const auto&) { incoming[rank].emplace_back(); });
        if (!incoming[rank].empty())
            MPI_Irecv(incoming[rank].data(), length_of(incoming[rank]), MPI_DOUBLE,
                      static_cast<int>(rank), motion_tag, comm, &requests.emplace_back());
        visit_gained<D>(before, after, me, rank,
                        [&](const auto& node) { outgoing[rank].push_back(last[old.index(node)]); });
        if (!outgoing[rank].empty())
            MPI_Isend(outgoing[rank].data(), length_of(outgoing[rank]), MPI_DOUBLE,
                      static_cast<int>(rank), motion_tag, comm, &requests.emplace_back());
    }
    std::ranges::fill(patch.motion, NodeMotion<D>{});
    visit_rows<D>(intersection<D>(before[me], after[me]),
                  [&](const std::array<int, D>& node, std::size_t length) {
                      std::copy_n(&last[old.index(node)], length, &patch.motion[patch.index(node)]);
                  });
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (std::size_t rank = 0; rank < num_ranks; ++rank) {
        const NodeMotion<D>* from = incoming[rank].data();
        if (!incoming[rank].empty())
            visit_gained<D>(before, after, rank, me,
                            [&](const auto& node) { patch.motion[patch.index(node)] = *from++; });
    }
}

template void carry_motion<2>(std::span<const NodeRange<2>>, std::span<const NodeRange<2>>,
                              std::span<const NodeMotion<2>>, GridPatch<2>&, MPI_Comm);
template void carry_motion<3>(std::span<const NodeRange<3>>, std::span<const NodeRange<3>>,
                              std::span<const NodeMotion<3>>, GridPatch<3>&, MPI_Comm);

}  // namespace mpm
