#pragma once

#include "zoltan/handle/last_partition.hpp"
#include "zoltan/handle/parameters.hpp"
#include "zoltan/handle/workspace.hpp"

#include <rrcb/balance.hpp>

#include <mpi.h>
#include <zoltan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// A duplicate of the communicator with which a handle was created, only for this handle.
class Communicator {
  public:
    /// Takes over `duplicate`. Throws Error or std::bad_alloc; then the caller keeps it.
    explicit Communicator(MPI_Comm duplicate);
    ~Communicator();
    Communicator(const Communicator&) = delete;
    Communicator& operator=(const Communicator&) = delete;

    MPI_Comm get() const { return comm_; }
    int rank() const { return rank_; }
    int size() const { return size_; }

    /// Scratch, a number for each rank, to receive into when memory is short. Pages that are not
    /// used take none.
    std::span<int> per_rank() { return {per_rank_.get(), static_cast<std::size_t>(size_)}; }

  private:
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 0;
    std::unique_ptr<int[]> per_rank_;
};

/// One entry of Zoltan_LB_Set_Part_Sizes.
struct PartSize {
    int part = 0;
    bool global = true;  ///< false: the part is counted from the first one on this rank
    float size = 0;
    int weight = 0;  ///< index of the weight that the size is for
};

/// Result of the last partition. It is valid while the objects are unchanged and in the parts they
/// were sent to: a program that balances until nothing changes comes to an end.
struct KeptObjects {
    Report report;
    std::uint64_t checksum = 0;  ///< of the objects of all ranks and their parts
};

/// State of a handle, shared with its copies.
struct Settings {
    Parameters parameters;
    std::vector<PartSize> part_sizes;
    std::optional<KeptObjects> kept;  ///< of the last partition; none once a parameter was changed
    bool zoltan_has_cuts = false;     ///< of the last partition, which the real Zoltan made
    bool axes_changed = false;        ///< a parameter that chooses axes was changed after it
    bool deserialized = false;        ///< Zoltan's parameters were set without the plug-in
    bool replacement_asked = false;   ///< by RRCB_REPLACE, on any rank of the communicator
    bool is_verbose = false;          ///< by RRCB_VERBOSE, on any rank of the communicator
    bool inside_hier = false;         ///< made by Zoltan, for one of HIER's levels
};

/// The plug-in's state of a Zoltan_Struct.
struct State : Settings {
    std::unique_ptr<Communicator> communicator;
    std::optional<LastPartition> last;  ///< of the last partition
    Workspace workspace;
};

/// Returns NUM_GLOBAL_PARTS as Zoltan takes it, -1 if it is not set.
inline int asked_global_parts(const State& state) {
    const int asked = state.parameters.num_global_parts;
    return asked == one_per_rank ? state.communicator->size() : asked;
}

/// Side table of handles. Threads may use it at the same time; a handle belongs to one of them.
/// Returns the state of a handle, or null if the plug-in has not made the handle.
State* find_state(const Zoltan_Struct* zz);
void add_state(const Zoltan_Struct* zz, State&& state);
void remove_state(const Zoltan_Struct* zz);  ///< collective, as it frees the communicator
bool any_handle_made();                      ///< since the process began

/// Copies everything except the communicator and what is shared by it. Throws std::bad_alloc; then
/// `to` is unchanged.
void copy_contents(State& to, const State& from);

}  // namespace rrcb::zoltan
