#include "progress.hpp"

#include <cstdio>

namespace comparisons {

void Progress::start(const std::string& label, int num_steps) {
    label_ = label;
    num_steps_ = num_steps;
    done_ = 0;
    draw();
}

void Progress::advance() {
    const int percent_before = done_ * 100 / num_steps_;
    ++done_;
    if (done_ * 100 / num_steps_ != percent_before) draw();
}

void Progress::draw() const {
    if (!shown_) return;
    constexpr int width = 40;
    const int filled = done_ * width / num_steps_;
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r%-28s [%s] %3d %%%s", label_.c_str(), bar.c_str(),
                 done_ * 100 / num_steps_, done_ == num_steps_ ? "\n" : "");
    std::fflush(stderr);
}

}  // namespace comparisons
