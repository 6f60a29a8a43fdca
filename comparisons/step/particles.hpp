#pragma once

#include <rrcb/rrcb.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace comparisons {

/// The particles of this rank and the ghosts near them, in columns as a program has them.
/// Positions, velocities and forces are interleaved.
struct Particles {
    int dimension = 0;
    std::vector<double> x{}, v{}, forces{};
    std::vector<std::int64_t> ids{};
    std::vector<double> ghost_x{}, ghost_v{}, ghost_forces{};
    std::vector<std::int64_t> ghost_ids{};

    std::size_t size() const { return ids.size(); }
    std::size_t width() const { return static_cast<std::size_t>(dimension); }
    rrcb::Points points() const { return rrcb::Points(x, dimension); }

    rrcb::Column<double> column(const std::vector<double>& values) const {
        return rrcb::column(values, width());
    }
};

}  // namespace comparisons
