#include "parallel/ghost_nodes_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

constexpr int ghost_tag = 1;
constexpr auto nowhere = static_cast<std::size_t>(-1);

template <int D>
std::size_t width(const GridPatch<D>& patch) {
    static_assert(sizeof(NodeSums<D>) == (1 + 2 * D) * sizeof(double));
    return 1 + 2 * D + patch.fields.size();
}

/// Returns whether any point reaches a node. A node can have fields even if all its weights are 0.
template <int D>
bool is_reached(const GridPatch<D>& patch, std::size_t n) {
    if (patch.sums[n].mass > 0) return true;
    for (const std::vector<double>& field : patch.fields)
        if (field[n] != 0) return true;
    return false;
}

/// Appends the sums and fields of a node to a message.
template <int D>
void pack(const GridPatch<D>& patch, std::size_t n, std::vector<double>& message) {
    const NodeSums<D>& node = patch.sums[n];
    message.push_back(node.mass);
    message.insert(message.end(), node.momentum.begin(), node.momentum.end());
    message.insert(message.end(), node.force.begin(), node.force.end());
    for (const std::vector<double>& field : patch.fields) message.push_back(field[n]);
}

/// Adds the next values of a message to the sums and fields of a node.
template <int D>
void add(const double* from, std::size_t n, GridPatch<D>& patch) {
    NodeSums<D>& node = patch.sums[n];
    node.mass += *from++;
    for (double& component : node.momentum) component += *from++;
    for (double& component : node.force) component += *from++;
    for (std::vector<double>& field : patch.fields) field[n] += *from++;
}

template <int D>
std::size_t num_nodes(const NodeRange<D>& range) {
    std::size_t product = 1;
    for (const int count : range.count) product *= static_cast<std::size_t>(count);
    return product;
}

template <int D>
bool contains(const NodeRange<D>& range, const std::array<int, D>& node) {
    for (std::size_t a = 0; a < D; ++a)
        if (node[a] < range.begin[a] || node[a] >= range.begin[a] + range.count[a]) return false;
    return true;
}

}  // namespace

template <int D>
GhostNodes<D>::GhostNodes(std::span<const NodeRange<D>> ranges, MPI_Comm comm)
    : comm_(comm), rank_(rank_of(comm)) {
    for (int rank = 0; rank < static_cast<int>(ranges.size()); ++rank) {
        const NodeRange<D> range = intersection<D>(ranges[static_cast<std::size_t>(rank_)],
                                                   ranges[static_cast<std::size_t>(rank)]);
        if (rank == rank_ || range.empty()) continue;
        ranks_.push_back(rank);
        neighbours_.push_back({range, {}, {}, {}});
    }
    requests_.resize(2 * ranks_.size());
}

template <int D>
void GhostNodes<D>::number(const GridPatch<D>& patch) {
    common_.clear();
    for (Neighbour& neighbour : neighbours_) {
        neighbour.nodes.clear();
        visit_nodes<D>(neighbour.range, [&](const std::array<int, D>& node) {
            const bool is_mine = contains<D>(patch.nodes, node);
            neighbour.nodes.push_back(is_mine ? patch.index(node) : nowhere);
            if (is_mine) common_.push_back(neighbour.nodes.back());
        });
    }
    std::ranges::sort(common_);
    common_.erase(std::unique(common_.begin(), common_.end()), common_.end());
}

template <int D>
void GhostNodes<D>::sum(GridPatch<D>& patch) {
    reached_.clear();
    own_.clear();
    for (const std::size_t n : common_)
        if (is_reached(patch, n)) reached_.push_back(n);
    receive_any(width(patch));
    send_all(patch);
    for (const std::size_t n : reached_) {
        pack(patch, n, own_);
        patch.sums[n] = {};
        for (std::vector<double>& field : patch.fields) field[n] = 0;
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    // All ranks start from 0 and add in the order of the ranks, so their sums are bit-identical.
    std::size_t k = 0;
    for (; k < ranks_.size() && ranks_[k] < rank_; ++k) unpack(k, patch);
    for (std::size_t i = 0; i < reached_.size(); ++i)
        add(own_.data() + i * width(patch), reached_[i], patch);
    for (; k < ranks_.size(); ++k) unpack(k, patch);
}

/// Starts to receive messages, each with room for all common nodes. A message begins with the
/// number of its runs, followed by the first node and the number of nodes of each run.
template <int D>
void GhostNodes<D>::receive_any(std::size_t width) {
    for (std::size_t k = 0; k < ranks_.size(); ++k) {
        const std::size_t nodes = num_nodes<D>(neighbours_[k].range);
        std::vector<double>& incoming = neighbours_[k].incoming;
        incoming.resize(1 + 2 * ((nodes + 1) / 2) + nodes * width);
        MPI_Irecv(incoming.data(), static_cast<int>(incoming.size()), MPI_DOUBLE, ranks_[k],
                  ghost_tag, comm_, &requests_[k]);
    }
}

template <int D>
void GhostNodes<D>::send_all(const GridPatch<D>& patch) {
    std::vector<std::size_t> sent;
    for (std::size_t k = 0; k < ranks_.size(); ++k) {
        const std::vector<std::size_t>& nodes = neighbours_[k].nodes;
        std::vector<double>& message = neighbours_[k].outgoing;
        message.assign(1, 0);
        sent.clear();
        std::size_t next = nowhere;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i] == nowhere || !is_reached(patch, nodes[i])) continue;
            if (i != next) {
                message.insert(message.end(), {static_cast<double>(i), 0});
                ++message.front();
            }
            next = i + 1;
            ++message.back();
            sent.push_back(nodes[i]);
        }
        for (const std::size_t n : sent) pack(patch, n, message);
        MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, ranks_[k],
                  ghost_tag, comm_, &requests_[ranks_.size() + k]);
    }
}

/// Adds a message to the nodes of the patch. Nodes outside the patch are skipped.
template <int D>
void GhostNodes<D>::unpack(std::size_t neighbour, GridPatch<D>& patch) const {
    const auto& [range, nodes, outgoing, message] = neighbours_[neighbour];
    const auto num_runs = static_cast<std::size_t>(message.front());
    const double* from = message.data() + 1 + 2 * num_runs;
    for (std::size_t r = 0; r < num_runs; ++r) {
        const auto first = static_cast<std::size_t>(message[1 + 2 * r]);
        const std::size_t end = first + static_cast<std::size_t>(message[2 + 2 * r]);
        for (std::size_t i = first; i < end; ++i, from += width(patch))
            if (nodes[i] != nowhere) add(from, nodes[i], patch);
    }
}

template class GhostNodes<2>;
template class GhostNodes<3>;

}  // namespace mpm
