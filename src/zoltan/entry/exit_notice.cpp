#include "verbose_mpi.hpp"
#include "zoltan/call/call_log_mpi.hpp"
#include "zoltan/handle/replacement.hpp"
#include "zoltan/handle/state.hpp"
#include "zoltan/real/message.hpp"

#include <rrcb/version.hpp>

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace rrcb::zoltan {

namespace {

bool has_used_mpi() {
    int initialized = 0;
    return MPI_Initialized(&initialized) == MPI_SUCCESS && initialized != 0;
}

/// Returns whether this is the first process. Asks the launcher's environment, because MPI has
/// ended.
bool is_first_process() {
    for (const char* name :
         {"PMIX_RANK", "OMPI_COMM_WORLD_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "SLURM_PROCID"}) {
        const char* rank = std::getenv(name);
        if (rank != nullptr) return std::string_view(rank) == "0";
    }
    return true;
}

/// Prints a notice if RRCB was asked for but no handle was made through it, for example because the
/// program has Zoltan as a static archive. Shells and launchers inherit the environment as well;
/// they print nothing, because they do not use MPI.
__attribute__((destructor)) void tell_if_asked_for_nothing() {
    if (any_call_answered() || !has_used_mpi() || !is_first_process()) return;
    if (is_verbosity_asked()) std::printf("RRCB %s: no calls\n", version());
    if (any_handle_made() || !is_replacement_asked()) return;
    print_warning(0, "RRCB_REPLACE",
                  "the program made no handle through RRCB: it holds Zoltan as a static archive, "
                  "has it in front of RRCB, or does not use it");
}

}  // namespace

}  // namespace rrcb::zoltan
