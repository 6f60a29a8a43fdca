#pragma once

#include <rrcb/ghosts.hpp>

#include <optional>
#include <span>

namespace rrcb::detail {

/// Reads the distances of a cutoff.
struct CutoffAccess {
    static const std::optional<double>& of_all(const Cutoff& cutoff) { return cutoff.of_all_; }
    static const std::optional<std::span<const double>>& of_each(const Cutoff& cutoff) {
        return cutoff.of_each_;
    }
};

}  // namespace rrcb::detail
