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

/// A duplicate of the communicator with which a handle was created. Only this handle uses it.
class Communicator {
  public:
    /// Takes ownership of `duplicate`. If it throws Error or std::bad_alloc, the caller still owns
    /// it.
    explicit Communicator(MPI_Comm duplicate);
    ~Communicator();
    Communicator(const Communicator&) = delete;
    Communicator& operator=(const Communicator&) = delete;

    MPI_Comm get() const { return comm_; }
    int rank() const { return rank_; }
    int size() const { return size_; }

    /// Returns one number for each rank as scratch memory, into which a rank can receive when
    /// memory is short. Its pages take no memory until they are used.
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
    bool global = true;  ///< if false, the part is counted from the first one on this rank
    float size = 0;
    int weight = 0;  ///< index of the weight that the size is for
};

/// Result of the last partition. It is valid as long as the objects are unchanged and in the parts
/// that they were sent to. A program that balances until nothing changes therefore ends.
struct KeptObjects {
    Report report;
    std::uint64_t checksum = 0;  ///< sum over the objects of all ranks and their parts
};

/// The part of a handle's state that copies of the handle get as well.
struct Settings {
    Parameters parameters;
    std::vector<PartSize> part_sizes;
    std::optional<KeptObjects> kept;  ///< empty when a parameter has been changed since the last
                                      ///< partition
    bool zoltan_has_cuts = false;     ///< whether the real Zoltan has made the last partition
    bool axes_changed = false;  ///< whether a parameter that affects the axes of cuts has changed
                                ///< since the last partition
    bool deserialized = false;  ///< whether Zoltan's parameters were set without the plug-in
    bool replacement_asked =
        false;                 ///< whether RRCB_REPLACE is set on any rank of the communicator
    bool is_verbose = false;   ///< whether RRCB_VERBOSE is set on any rank of the communicator
    bool inside_hier = false;  ///< whether Zoltan has made the handle for a level of HIER
};

/// The plug-in's state of a Zoltan_Struct.
struct State : Settings {
    std::unique_ptr<Communicator> communicator;
    std::optional<LastPartition> last;  ///< of the last partition
    Workspace workspace;
};

/// Returns the value of NUM_GLOBAL_PARTS according to Zoltan's rules; -1 if it is not set.
inline int asked_global_parts(const State& state) {
    const int asked = state.parameters.num_global_parts;
    return asked == one_per_rank ? state.communicator->size() : asked;
}

/// Access to the side table of handles. Threads may call these at the same time, but each handle
/// must be used by one thread only. find_state() returns the state of a handle, or null if the
/// plug-in has not made the handle.
State* find_state(const Zoltan_Struct* zz);
void add_state(const Zoltan_Struct* zz, State&& state);
void remove_state(const Zoltan_Struct* zz);  ///< collective, because it frees the communicator
bool any_handle_made();                      ///< in this process, at any time

/// Copies the settings and the last partition. If it throws std::bad_alloc, `to` is unchanged.
void copy_contents(State& to, const State& from);

}  // namespace rrcb::zoltan
