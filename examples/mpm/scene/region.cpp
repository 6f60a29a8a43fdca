#include <mpm/region.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

double squared_distance(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns whether a ray along x from a point crosses an edge.
bool crosses(const Vector& at, const Vector& a, const Vector& b) {
    if ((a[1] > at[1]) == (b[1] > at[1])) return false;
    return at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

}  // namespace

Region box_region(const Box& box) {
    return [box](const Vector& at) { return contains(box, at); };
}

Region ball_region(const Vector& centre, double radius) {
    return [=](const Vector& at) { return squared_distance(at, centre) <= radius * radius; };
}

Region half_space_region(const Vector& point, const Vector& normal) {
    return [=](const Vector& at) { return dot(at, normal) <= dot(point, normal); };
}

Region polygon_region(std::vector<Vector> corners) {
    return [corners = std::move(corners)](const Vector& at) {
        bool inside = false;
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (crosses(at, corners[i], corners[(i + 1) % corners.size()])) inside = !inside;
        return inside;
    };
}

bool crosses_itself(const std::vector<Vector>& corners) {
    const auto side = [](const Vector& a, const Vector& b, const Vector& at) {
        return (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
    };
    const auto are_apart = [&](const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
        return (side(a, b, c) < 0 && side(a, b, d) > 0) || (side(a, b, c) > 0 && side(a, b, d) < 0);
    };
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 2; j < count; ++j) {
            const Vector &a = corners[i], &b = corners[i + 1];
            const Vector &c = corners[j], &d = corners[(j + 1) % count];
            if (are_apart(a, b, c, d) && are_apart(c, d, a, b)) return true;
        }
    return false;
}

Region both_of(Region a, Region b) {
    return [a = std::move(a), b = std::move(b)](const Vector& at) { return a(at) || b(at); };
}

Region without(Region a, Region b) {
    return [a = std::move(a), b = std::move(b)](const Vector& at) { return a(at) && !b(at); };
}

Region common_to(Region a, Region b) {
    return [a = std::move(a), b = std::move(b)](const Vector& at) { return a(at) && b(at); };
}

VelocityField velocity_field(const VelocityForm& form) {
    return [form](const Vector& at) {
        Vector velocity = form.constant;
        velocity[0] -= form.rotation_rate * (at[1] - form.rotation_centre[1]);
        velocity[1] += form.rotation_rate * (at[0] - form.rotation_centre[0]);
        const double wave = std::sin(dot(form.sine_wave_number, at) + form.sine_phase);
        for (std::size_t a = 0; a < 3; ++a) velocity[a] += form.sine_amplitude[a] * wave;
        return velocity;
    };
}

}  // namespace mpm
