#include <mpm/region.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

constexpr double relative_tolerance = 1e-9;

double squared_distance(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns the distance in the x-y plane from a point to the line between two others.
double distance_to_edge(const Vector& at, const Vector& a, const Vector& b) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const double along = (at[0] - a[0]) * dx + (at[1] - a[1]) * dy;
    const double share = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
    return std::hypot(at[0] - a[0] - share * dx, at[1] - a[1] - share * dy);
}

/// Returns whether a ray along x from a point crosses an edge.
bool crosses(const Vector& at, const Vector& a, const Vector& b) {
    if ((a[1] > at[1]) == (b[1] > at[1])) return false;
    return at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

}  // namespace

Region box_region(const Box& box) {
    Box wide = box;
    for (std::size_t a = 0; a < 3; ++a) {
        const double tolerance = relative_tolerance * (box.upper[a] - box.lower[a]);
        wide.lower[a] -= tolerance;
        wide.upper[a] += tolerance;
    }
    return [wide](const Vector& at) { return contains(wide, at); };
}

Region ball_region(const Vector& centre, double radius) {
    const double reach = radius * (1 + relative_tolerance);
    return [=](const Vector& at) { return squared_distance(at, centre) <= reach * reach; };
}

Region half_space_region(const Vector& point, const Vector& normal) {
    const double size = std::sqrt(dot(normal, normal));
    return [=](const Vector& at) {
        const double scale = size * std::sqrt(squared_distance(at, point));
        return dot(at, normal) - dot(point, normal) <= relative_tolerance * scale;
    };
}

Region polygon_region(std::vector<Vector> corners) {
    double size = 0;
    for (const Vector& corner : corners)
        size = std::max(size, std::sqrt(squared_distance(corner, corners.front())));
    return [corners = std::move(corners), tolerance = relative_tolerance * size](const Vector& at) {
        bool inside = false;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vector &a = corners[i], &b = corners[(i + 1) % corners.size()];
            if (distance_to_edge(at, a, b) <= tolerance) return true;
            if (crosses(at, a, b)) inside = !inside;
        }
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
