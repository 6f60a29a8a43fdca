#include <mpm/particles.hpp>

#include <algorithm>
#include <stdexcept>

namespace mpm {

Column Particles::add_column(std::string_view name) {
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return static_cast<Column>(found - names_.begin());
    names_.emplace_back(name);
    columns_.emplace_back(size(), 0.0);
    return columns_.size() - 1;
}

bool Particles::has_column(std::string_view name) const {
    return std::ranges::find(names_, name) != names_.end();
}

Column Particles::find_column(std::string_view name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end())
        throw std::out_of_range("the points of this scene have no column '" + std::string(name) +
                                "'");
    return static_cast<Column>(found - names_.begin());
}

void Particles::append(std::span<const double> rows) {
    const std::size_t width = columns_.size();
    const std::size_t num_new = rows.size() / width, begin = size();
    for (std::size_t c = 0; c < width; ++c) {
        std::vector<double>& column = columns_[c];
        column.resize(begin + num_new);
        for (std::size_t i = 0; i < num_new; ++i) column[begin + i] = rows[i * width + c];
    }
}

void Particles::copy_row(std::size_t point, std::span<double> row) const {
    for (std::size_t c = 0; c < columns_.size(); ++c) row[c] = columns_[c][point];
}

void Particles::remove(std::span<const std::size_t> points) {
    std::size_t last = size();
    // Starts with the last point, so that all points behind `last` have been removed already.
    for (std::size_t k = points.size(); k-- > 0;) {
        --last;
        for (std::vector<double>& column : columns_) column[points[k]] = column[last];
    }
    for (std::vector<double>& column : columns_) column.resize(last);
}

void Particles::reorder(std::span<const std::size_t> order) {
    scratch_.resize(size());
    for (std::vector<double>& column : columns_) {
        for (std::size_t i = 0; i < scratch_.size(); ++i) scratch_[i] = column[order[i]];
        column.swap(scratch_);
    }
}

MotionColumns add_motion_columns(Particles& particles, int dimension) {
    constexpr std::array<char, 3> axes{'x', 'y', 'z'};
    const auto add_triple = [&](const std::string& prefix) {
        std::array<Column, 3> columns{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
            columns[a] = particles.add_column(prefix + axes[a]);
        return columns;
    };
    MotionColumns motion;
    motion.position = add_triple("");
    motion.velocity = add_triple("velocity_");
    motion.mass = particles.add_column("mass");
    motion.volume = particles.add_column("volume");
    motion.id = particles.add_column("id");
    return motion;
}

Positions positions_of(const Particles& particles, const MotionColumns& motion, int dimension) {
    const std::span<const double> x = particles[motion.position[0]];
    const std::span<const double> y = particles[motion.position[1]];
    if (dimension == 2) return {x, y};
    return {x, y, particles[motion.position[2]], dimension};
}

}  // namespace mpm
