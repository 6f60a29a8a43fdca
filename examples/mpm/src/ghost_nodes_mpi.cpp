#include <mpm/ghost_nodes_mpi.hpp>

#include <algorithm>

namespace mpm {

namespace {

constexpr int ghost_tag = 1;
constexpr int doubles_per_node = sizeof(Node) / sizeof(double);
static_assert(sizeof(Node) == 5 * sizeof(double));

/// Calls visit(index of the first node of a row in the patch, length) for each row of a range.
template <typename Visit>
void visit_rows(const GridPatch& patch, const NodeRange& range, Visit visit) {
    for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
        visit(patch.index(range.first[0], j), static_cast<std::size_t>(range.count[0]));
}

void add_range(const std::vector<Node>& from, const NodeRange& range, GridPatch& patch) {
    const Node* node = from.data();
    visit_rows(patch, range, [&](std::size_t first, std::size_t length) {
        for (std::size_t n = first; n < first + length; ++n) add(*node++, patch.sums[n]);
    });
}

}  // namespace

GhostNodes::GhostNodes(std::span<const NodeRange> patches, MPI_Comm comm) : comm_(comm) {
    MPI_Comm_rank(comm, &rank_);
    const NodeRange& mine = patches[static_cast<std::size_t>(rank_)];
    GridPatch numbering{.shape = {}, .nodes = mine, .sums = {}, .motion = {}};
    for (int rank = 0; rank < static_cast<int>(patches.size()); ++rank) {
        const NodeRange range = intersection(mine, patches[static_cast<std::size_t>(rank)]);
        if (rank == rank_ || range.empty()) continue;
        ranks_.push_back(rank);
        ranges_.push_back(range);
        outgoing_.emplace_back();
        visit_rows(numbering, range, [&](std::size_t first, std::size_t length) {
            for (std::size_t n = first; n < first + length; ++n) shared_.push_back(n);
            outgoing_.back().resize(outgoing_.back().size() + length);
        });
    }
    incoming_ = outgoing_;
    requests_.resize(2 * ranks_.size());
    std::ranges::sort(shared_);
    shared_.erase(std::ranges::unique(shared_).begin(), shared_.end());
    own_.resize(shared_.size());
}

void GhostNodes::sum(GridPatch& patch) {
    exchange(patch);
    take_out_own(patch);
    const auto add_own = [&] {
        for (std::size_t k = 0; k < shared_.size(); ++k) add(own_[k], patch.sums[shared_[k]]);
    };
    std::size_t neighbour = 0;
    for (; neighbour < ranks_.size() && ranks_[neighbour] < rank_; ++neighbour)
        add_range(incoming_[neighbour], ranges_[neighbour], patch);
    add_own();
    for (; neighbour < ranks_.size(); ++neighbour)
        add_range(incoming_[neighbour], ranges_[neighbour], patch);
}

void GhostNodes::exchange(const GridPatch& patch) {
    const std::size_t num_neighbours = ranks_.size();
    for (std::size_t k = 0; k < num_neighbours; ++k) {
        MPI_Irecv(incoming_[k].data(), static_cast<int>(incoming_[k].size()) * doubles_per_node,
                  MPI_DOUBLE, ranks_[k], ghost_tag, comm_, &requests_[k]);
    }
    for (std::size_t k = 0; k < num_neighbours; ++k) {
        Node* node = outgoing_[k].data();
        visit_rows(patch, ranges_[k], [&](std::size_t first, std::size_t length) {
            node = std::copy_n(patch.sums.data() + first, length, node);
        });
        MPI_Isend(outgoing_[k].data(), static_cast<int>(outgoing_[k].size()) * doubles_per_node,
                  MPI_DOUBLE, ranks_[k], ghost_tag, comm_, &requests_[num_neighbours + k]);
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

void GhostNodes::take_out_own(GridPatch& patch) {
    for (std::size_t k = 0; k < shared_.size(); ++k) {
        own_[k] = patch.sums[shared_[k]];
        patch.sums[shared_[k]] = {};
    }
}

}  // namespace mpm
