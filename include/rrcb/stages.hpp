#pragma once

#include <rrcb/export.h>

#include <array>

namespace rrcb {

/// Stages of a call of `balance`, in this order; see StageObserver for repeated ones.
enum class Stage {
    moments,     ///< local: the points are reduced to the contribution of this rank
    gather,      ///< the contributions travel to the root
    bisection,   ///< on the root, and observed only there
    broadcast,   ///< the cuts travel to every rank, which includes the wait for the root
    refinement,  ///< the cuts are moved by counts of the points, and the points assigned by them
    assignment   ///< local: the points assigned by the estimated cuts, if none are refined; by
                 ///< earlier cuts before the gather
};

/// All stages in their order.
inline constexpr std::array stages = {Stage::moments,   Stage::gather,     Stage::bisection,
                                      Stage::broadcast, Stage::refinement, Stage::assignment};

/// Returns "moments", "gather", ... Not collective.
RRCB_API const char* name_of(Stage stage);

/// Observes on its own rank when a stage of `balance` begins and when it ends.
///
/// Every stage ends before another begins, in failing calls too. Some come again in a
/// call: the broadcast if points stay after new cuts were counted, or if many ranks made the
/// parts, in the refinement; all from the gather on if earlier cuts do not stay.
/// The functions may not communicate over the communicator of the call, nor throw, since no rank
/// may fail alone.
class RRCB_API StageObserver {
  public:
    /// Ends an observer, which outlives the observed calls.
    virtual ~StageObserver() = default;
    /// Observes the beginning of a stage.
    virtual void begin(Stage stage) noexcept = 0;
    /// Observes the end of a stage.
    virtual void end(Stage stage) noexcept = 0;
};

}  // namespace rrcb
