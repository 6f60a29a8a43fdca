#pragma once

#include <string>

namespace comparisons {

/// A bar on standard error; silent unless it is shown.
class Progress {
  public:
    explicit Progress(bool shown) : shown_(shown) {}

    /// Starts a bar of `num_steps` steps (>= 1).
    void start(const std::string& label, int num_steps);

    /// One step is done; the last one ends the line.
    void advance();

  private:
    void draw() const;

    bool shown_;
    std::string label_;
    int num_steps_ = 1;
    int done_ = 0;
};

}  // namespace comparisons
