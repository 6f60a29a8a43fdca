#pragma once

#include <rrcb/cuts.hpp>

namespace rrcb {

/// A node on the way down the tree: its place in the preorder and the parts below it.
struct Descent {
    std::size_t node = 0;
    Part first_part = 0;
    int num_parts = 1;

    bool is_part() const { return num_parts == 1; }
    Descent lower() const { return {node + 1, first_part, lower_parts(num_parts)}; }
    Descent upper() const {
        const int below = lower_parts(num_parts);
        return {node + static_cast<std::size_t>(below), first_part + below, num_parts - below};
    }
};

inline Descent root_of(const Cuts& cuts) {
    return {0, 0, cuts.num_parts};
}

}  // namespace rrcb
