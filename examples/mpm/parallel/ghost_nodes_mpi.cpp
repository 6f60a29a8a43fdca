#include "parallel/ghost_nodes_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

constexpr int ghost_tag = 1;

template <int D>
std::size_t width(const GridPatch<D>& patch) {
    static_assert(sizeof(NodeSums<D>) == (1 + 2 * D) * sizeof(double));
    return 1 + 2 * D + patch.fields.size();
}

/// Copies the sums and fields of nodes into a message.
template <int D>
void pack(const GridPatch<D>& patch, const std::vector<std::size_t>& nodes,
          std::vector<double>& message) {
    message.resize(nodes.size() * width(patch));
    double* to = message.data();
    for (const std::size_t n : nodes) {
        const NodeSums<D>& node = patch.sums[n];
        *to++ = node.mass;
        to = std::copy(node.momentum.begin(), node.momentum.end(), to);
        to = std::copy(node.force.begin(), node.force.end(), to);
        for (const std::vector<double>& field : patch.fields) *to++ = field[n];
    }
}

/// Adds a message to the sums and fields of nodes.
template <int D>
void unpack(const std::vector<double>& message, const std::vector<std::size_t>& nodes,
            GridPatch<D>& patch) {
    const double* from = message.data();
    for (const std::size_t n : nodes) {
        NodeSums<D>& node = patch.sums[n];
        node.mass += *from++;
        for (double& component : node.momentum) component += *from++;
        for (double& component : node.force) component += *from++;
        for (std::vector<double>& field : patch.fields) field[n] += *from++;
    }
}

}  // namespace

template <int D>
GhostNodes<D>::GhostNodes(std::span<const NodeRange<D>> patches, MPI_Comm comm)
    : comm_(comm), rank_(rank_of(comm)) {
    GridPatch<D> numbering;
    numbering.nodes = patches[static_cast<std::size_t>(rank_)];
    for (int rank = 0; rank < static_cast<int>(patches.size()); ++rank) {
        const NodeRange<D> range =
            intersection<D>(numbering.nodes, patches[static_cast<std::size_t>(rank)]);
        if (rank == rank_ || range.empty()) continue;
        ranks_.push_back(rank);
        nodes_.emplace_back();
        visit_nodes<D>(range, [&](const std::array<int, D>& node) {
            nodes_.back().push_back(numbering.index(node));
        });
        shared_.insert(shared_.end(), nodes_.back().begin(), nodes_.back().end());
    }
    outgoing_.resize(ranks_.size());
    incoming_.resize(ranks_.size());
    requests_.resize(2 * ranks_.size());
    std::ranges::sort(shared_);
    shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
}

template <int D>
void GhostNodes<D>::sum(GridPatch<D>& patch) {
    exchange(patch);
    pack(patch, shared_, own_);
    for (const std::size_t n : shared_) {
        patch.sums[n] = {};
        for (std::vector<double>& field : patch.fields) field[n] = 0;
    }
    // All ranks add from 0 on in the order of the ranks, so they get the same bits.
    std::size_t neighbour = 0;
    for (; neighbour < ranks_.size() && ranks_[neighbour] < rank_; ++neighbour)
        unpack(incoming_[neighbour], nodes_[neighbour], patch);
    unpack(own_, shared_, patch);
    for (; neighbour < ranks_.size(); ++neighbour)
        unpack(incoming_[neighbour], nodes_[neighbour], patch);
}

template <int D>
void GhostNodes<D>::exchange(const GridPatch<D>& patch) {
    const std::size_t num_neighbours = ranks_.size();
    for (std::size_t k = 0; k < num_neighbours; ++k) {
        incoming_[k].resize(nodes_[k].size() * width(patch));
        MPI_Irecv(incoming_[k].data(), static_cast<int>(incoming_[k].size()), MPI_DOUBLE, ranks_[k],
                  ghost_tag, comm_, &requests_[k]);
    }
    for (std::size_t k = 0; k < num_neighbours; ++k) {
        pack(patch, nodes_[k], outgoing_[k]);
        MPI_Isend(outgoing_[k].data(), static_cast<int>(outgoing_[k].size()), MPI_DOUBLE, ranks_[k],
                  ghost_tag, comm_, &requests_[num_neighbours + k]);
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

template class GhostNodes<2>;
template class GhostNodes<3>;

}  // namespace mpm
