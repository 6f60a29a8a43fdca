#pragma once

#include "arithmetic/non_stop.hpp"

#include <rrcb/stages.hpp>

namespace rrcb {

/// Reports a stage to the observer, if there is one; the stage lasts until the end of the scope.
/// The observer runs with the caller's floating-point environment.
class StageScope {
  public:
    StageScope(StageObserver* observer, Stage stage, const NonStop& arithmetic)
        : observer_(observer), stage_(stage), arithmetic_(arithmetic) {
        if (observer_ != nullptr) arithmetic_.outside([&] { observer_->begin(stage_); });
    }
    ~StageScope() {
        if (observer_ != nullptr) arithmetic_.outside([&] { observer_->end(stage_); });
    }
    StageScope(const StageScope&) = delete;
    StageScope& operator=(const StageScope&) = delete;

  private:
    StageObserver* observer_;
    Stage stage_;
    const NonStop& arithmetic_;
};

}  // namespace rrcb
