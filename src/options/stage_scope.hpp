#pragma once

#include <rrcb/stages.hpp>

namespace rrcb {

/// One stage, from here to the end of the scope; nothing at all without an observer.
class StageScope {
  public:
    StageScope(StageObserver* observer, Stage stage) : observer_(observer), stage_(stage) {
        if (observer_ != nullptr) observer_->begin(stage_);
    }
    ~StageScope() {
        if (observer_ != nullptr) observer_->end(stage_);
    }
    StageScope(const StageScope&) = delete;
    StageScope& operator=(const StageScope&) = delete;

  private:
    StageObserver* observer_;
    Stage stage_;
};

}  // namespace rrcb
