#include "create_mpi.hpp"

#include "../agreement_mpi.hpp"
#include "dump_mpi.hpp"
#include "mpi/communicator.hpp"
#include "replacement.hpp"
#include "state.hpp"

#include <memory>

namespace rrcb::zoltan {

void create_state(const Zoltan_Struct* zz, MPI_Comm user) {
    MPI_Comm duplicate = MPI_COMM_NULL;
    std::shared_ptr<Communicator> communicator;
    Member me{user};
    me.always([&] { mpi::check(MPI_Comm_dup(user, &duplicate), "MPI_Comm_dup"); });
    me.locally([&] {
        communicator = std::make_shared<Communicator>(duplicate);
        State& state = add_state(zz, communicator);
        state.parameters = initial_parameters();
        read_dump_environment(state);
    });
    try {
        agree(me);
    } catch (...) {
        remove_state(zz);
        if (communicator == nullptr && duplicate != MPI_COMM_NULL) MPI_Comm_free(&duplicate);
        throw;
    }
}

}  // namespace rrcb::zoltan
