#pragma once

#include <cstdio>
#include <string>

namespace comparisons {

/// Draws a progress bar on standard error if it is enabled.
class Progress {
  public:
    explicit Progress(bool shown) : shown_(shown) {}

    /// Starts a bar of `num_steps` steps (>= 1).
    void start(const std::string& label, int num_steps) {
        label_ = label;
        num_steps_ = num_steps;
        done_ = 0;
        draw();
    }

    /// Advances the bar by a step. The last step ends the line.
    void advance() {
        const int percent_before = percent();
        ++done_;
        if (percent() != percent_before) draw();
    }

  private:
    int percent() const { return done_ * 100 / num_steps_; }

    void draw() const {
        if (!shown_) return;
        constexpr int width = 40;
        const int filled = done_ * width / num_steps_;
        const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
        std::fprintf(stderr, "\r%-28s [%s] %3d %%%s", label_.c_str(), bar.c_str(), percent(),
                     done_ == num_steps_ ? "\n" : "");
        std::fflush(stderr);
    }

    bool shown_;
    std::string label_;
    int num_steps_ = 1;
    int done_ = 0;
};

}  // namespace comparisons
