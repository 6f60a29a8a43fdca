#pragma once

#include <cstdio>
#include <string>
#include <utility>

namespace comparisons {

/// Shows on standard error how much of a long phase is done, if asked to.
class Progress {
  public:
    Progress(bool is_shown, std::string phase, int num_steps)
        : is_shown_(is_shown), phase_(std::move(phase)), num_steps_(num_steps) {}

    /// Adds steps that are done. The last ones end the line.
    void advance(int steps) {
        done_ += steps;
        if (is_shown_)
            std::fprintf(stderr, "\r%s: %d of %d%s", phase_.c_str(), done_, num_steps_,
                         done_ < num_steps_ ? "" : "\n");
    }

  private:
    bool is_shown_;
    std::string phase_;
    int num_steps_;
    int done_ = 0;
};

}  // namespace comparisons
