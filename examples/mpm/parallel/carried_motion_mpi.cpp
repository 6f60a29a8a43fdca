#include "parallel/carried_motion_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Doubles to or from all ranks, one rank after the other.
struct Message {
    std::vector<double> values;
    std::vector<int> counts, offsets;
};

/// Doubles of a node in a message.
template <int D>
constexpr std::size_t width = sizeof(NodeMotion<D>) / sizeof(double);

/// Message with room for the nodes that a range shares with that of each rank.
template <int D>
Message room(const GridPatch<D>& patch, std::span<const NodeRange<D>> others) {
    Message message;
    int end = 0;
    for (const NodeRange<D>& other : others) {
        std::size_t num_nodes = 0;
        visit_rows<D>(intersection<D>(patch.nodes, other),
                      [&](const std::array<int, D>&, std::size_t length) { num_nodes += length; });
        message.offsets.push_back(end);
        message.counts.push_back(static_cast<int>(num_nodes * width<D>));
        end += message.counts.back();
    }
    message.values.resize(static_cast<std::size_t>(end));
    return message;
}

/// Calls visit(number in the patch, place in the message) for each shared node.
template <int D, typename Visit>
void visit_shared(const GridPatch<D>& patch, std::span<const NodeRange<D>> others, Visit visit) {
    std::size_t at = 0;
    for (const NodeRange<D>& other : others)
        visit_nodes<D>(intersection<D>(patch.nodes, other), [&](const std::array<int, D>& node) {
            visit(patch.index(node), at);
            at += width<D>;
        });
}

}  // namespace

template <int D>
void carry_motion(std::span<const NodeRange<D>> before, std::span<const NodeRange<D>> after,
                  const GridPatch<D>& from, GridPatch<D>& to, MPI_Comm comm) {
    static_assert(width<D> == 3 * D);
    Message sent = room<D>(from, after), received = room<D>(to, before);
    visit_shared<D>(from, after, [&](std::size_t n, std::size_t at) {
        const NodeMotion<D>& motion = from.motion[n];
        double* place = sent.values.data() + at;
        for (const auto& velocity :
             {motion.velocity, motion.velocity_change, motion.strain_velocity})
            place = std::ranges::copy(velocity, place).out;
    });
    MPI_Alltoallv(sent.values.data(), sent.counts.data(), sent.offsets.data(), MPI_DOUBLE,
                  received.values.data(), received.counts.data(), received.offsets.data(),
                  MPI_DOUBLE, comm);
    std::ranges::fill(to.motion, NodeMotion<D>{});
    visit_shared<D>(to, before, [&](std::size_t n, std::size_t at) {
        NodeMotion<D>& motion = to.motion[n];
        const double* place = received.values.data() + at;
        for (auto* velocity : {&motion.velocity, &motion.velocity_change, &motion.strain_velocity})
            place = std::ranges::copy_n(place, D, velocity->begin()).in;
    });
}

template void carry_motion<2>(std::span<const NodeRange<2>>, std::span<const NodeRange<2>>,
                              const GridPatch<2>&, GridPatch<2>&, MPI_Comm);
template void carry_motion<3>(std::span<const NodeRange<3>>, std::span<const NodeRange<3>>,
                              const GridPatch<3>&, GridPatch<3>&, MPI_Comm);

}  // namespace mpm
