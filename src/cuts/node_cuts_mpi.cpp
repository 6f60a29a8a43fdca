#include "cuts/node_cuts_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/gather_cuts_mpi.hpp"
#include "cuts/owned_cuts.hpp"

#include <algorithm>
#include <cstddef>

namespace rrcb {

void NodeCuts::make_room(int num_parts, Participant& self) {
    // What is made before a failure stays until MPI ends: to free it takes ranks that lack it.
    const int rank = mpi::rank_of(self.comm);
    MPI_Comm node = MPI_COMM_NULL;
    MPI_Comm leaders = MPI_COMM_NULL;
    MPI_Win window = MPI_WIN_NULL;
    self.check(MPI_Comm_split_type(self.comm, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &node),
               "MPI_Comm_split_type");
    agree(self);
    self.check(MPI_Comm_set_errhandler(node, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    const bool leads = mpi::rank_of(node) == 0;
    self.check(MPI_Comm_split(self.comm, leads ? 0 : MPI_UNDEFINED, rank, &leaders),
               "MPI_Comm_split");
    const auto num_cuts = static_cast<std::size_t>(num_parts) - 1;
    void* memory = nullptr;
    auto bytes = static_cast<MPI_Aint>(leads ? num_cuts * sizeof(Cut) : 0);
    self.check(MPI_Win_allocate_shared(bytes, sizeof(Cut), MPI_INFO_NULL, node, &memory, &window),
               "MPI_Win_allocate_shared");
    agree(self);
    int unit = 0;
    self.check(MPI_Win_shared_query(window, 0, &bytes, &unit, &memory), "MPI_Win_shared_query");
    agree(self);
    node_ = node;
    leaders_ = leaders;
    window_ = window;
    tree_ = {static_cast<Cut*>(memory), num_cuts};
}

NodeCuts::~NodeCuts() {
    if (window_ != MPI_WIN_NULL) MPI_Win_free(&window_);
    if (leaders_ != MPI_COMM_NULL) MPI_Comm_free(&leaders_);
    if (node_ != MPI_COMM_NULL) MPI_Comm_free(&node_);
}

/// After it every rank of the machine sees what the others have written.
void NodeCuts::wait_for_all(Participant& self) const {
    self.check(MPI_Win_fence(0, window_), "MPI_Win_fence");
}

void NodeCuts::gather(const Cuts& cuts, Participant& self) {
    const bool leads = leaders_ != MPI_COMM_NULL;
    wait_for_all(self);
    if (leads) std::ranges::fill(tree_, Cut{});
    wait_for_all(self);
    self.attempt([&] {
        for_each_owned(cuts, mpi::rank_of(self.comm), mpi::size_of(self.comm),
                       [&](std::size_t node, const Cut& cut) { tree_[node] = cut; });
    });
    wait_for_all(self);
    if (leads) join_cuts(tree_, leaders_, self);
    wait_for_all(self);
    agree(self);
}

}  // namespace rrcb
