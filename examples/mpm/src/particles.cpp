#include <mpm/particles.hpp>

#include <algorithm>
#include <stdexcept>

namespace mpm {

Column Particles::add_column(std::string_view name) {
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return static_cast<Column>(found - names_.begin());
    names_.emplace_back(name);
    columns_.emplace_back(size_, 0.0);
    return columns_.size() - 1;
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
    const std::size_t num_new = rows.size() / width;
    for (std::size_t c = 0; c < width; ++c) {
        std::vector<double>& column = columns_[c];
        column.resize(size_ + num_new);
        for (std::size_t i = 0; i < num_new; ++i) column[size_ + i] = rows[i * width + c];
    }
    size_ += num_new;
}

void Particles::copy_row(std::size_t point, std::span<double> row) const {
    for (std::size_t c = 0; c < columns_.size(); ++c) row[c] = columns_[c][point];
}

void Particles::remove(std::span<const std::size_t> points) {
    std::size_t last = size_;
    for (std::size_t k = points.size(); k-- > 0;) {
        --last;
        for (std::vector<double>& column : columns_) column[points[k]] = column[last];
    }
    size_ = last;
    for (std::vector<double>& column : columns_) column.resize(size_);
}

void Particles::reorder(std::span<const std::size_t> order) {
    scratch_.resize(size_);
    for (std::vector<double>& column : columns_) {
        for (std::size_t i = 0; i < size_; ++i) scratch_[i] = column[order[i]];
        column.swap(scratch_);
    }
}

MotionColumns add_motion_columns(Particles& particles) {
    return {.x = particles.add_column("x"),
            .y = particles.add_column("y"),
            .velocity_x = particles.add_column("velocity_x"),
            .velocity_y = particles.add_column("velocity_y"),
            .displacement_x = particles.add_column("displacement_x"),
            .displacement_y = particles.add_column("displacement_y"),
            .mass = particles.add_column("mass"),
            .volume = particles.add_column("volume"),
            .id = particles.add_column("id")};
}

}  // namespace mpm
