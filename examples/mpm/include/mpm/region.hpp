#pragma once

#include <mpm/scene.hpp>

#include <vector>

namespace mpm {

/// Returns the region of a box. A region is exact: Body states which points on its boundary belong
/// to a body.
Region box_region(const Box& box);
/// Returns the region of a ball; in two dimensions of a disc.
Region ball_region(const Vector& centre, double radius);
/// Returns the side of a plane that its normal points away from. The normal may have any length.
Region half_space_region(const Vector& point, const Vector& normal);
/// Returns the region of a polygon with these corners, at least 3; in three dimensions at any z.
Region polygon_region(std::vector<Vector> corners);
/// Returns whether two edges of a polygon cross.
bool crosses_itself(const std::vector<Vector>& corners);

Region both_of(Region a, Region b);    ///< in a or in b
Region without(Region a, Region b);    ///< in a but not in b
Region common_to(Region a, Region b);  ///< in a and in b

/// The velocity at the start. It is the sum of a constant, a rotation about an axis along z through
/// `rotation_centre`, and sine_amplitude * sin(sine_wave_number . x + sine_phase).
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
