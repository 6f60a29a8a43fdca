#pragma once

#include <mpm/scene.hpp>

#include <vector>

namespace mpm {

/// A box. Regions are closed: positions on the rim, or outside it by round-off, are inside.
Region box_region(const Box& box);
/// A ball; in two dimensions a disc.
Region ball_region(const Vector& centre, double radius);
/// The side behind a plane through a point with an outward normal of any length.
Region half_space_region(const Vector& point, const Vector& normal);
/// A polygon of the corners in their order, at least 3; in three dimensions at any z.
Region polygon_region(std::vector<Vector> corners);
/// Whether two edges of a polygon cross.
bool crosses_itself(const std::vector<Vector>& corners);

Region both_of(Region a, Region b);    ///< in a or in b
Region without(Region a, Region b);    ///< in a but not in b
Region common_to(Region a, Region b);  ///< in a and in b

/// Velocity at the start: a constant, plus the rotation rate times a turn about the z axis through
/// a centre, plus amplitude * sin(wave number . x + phase).
struct VelocityForm {
    Vector constant{};          ///< m/s
    double rotation_rate = 0;   ///< rad/s, anticlockwise
    Vector rotation_centre{};   ///< m
    Vector sine_amplitude{};    ///< m/s
    Vector sine_wave_number{};  ///< rad/m
    double sine_phase = 0;      ///< rad
};

VelocityField velocity_field(const VelocityForm& form);

}  // namespace mpm
