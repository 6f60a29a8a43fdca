#include "estimate/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rrcb {

namespace {

constexpr std::size_t sample_size = 512;
constexpr std::size_t left_out = sample_size / 64;  // at each end: more than strays are

/// Ends of most of the points along an axis.
struct Layers {
    double lower;
    double upper;

    double half() const { return upper / 2 - lower / 2; }

    void widen(double by) {
        lower -= by;
        upper += by;
    }
};

Layers span_of(const PointSample& sample, int axis) {
    std::array<double, sample_size> values;
    for (std::size_t k = 0; k < sample_size; ++k)
        values[k] = sample.positions[k][static_cast<std::size_t>(axis)];
    const auto first = values.begin() + left_out;
    const auto last = values.end() - 1 - left_out;
    std::ranges::nth_element(values, first);
    std::nth_element(first + 1, last, values.end());
    return {*first, *last};
}

/// Frames the layers of a mesh along an axis, if that makes them much narrower.
void frame_axis(const Layers& span, std::size_t axis, SupportMesh& mesh) {
    constexpr double much = 4;
    constexpr double margin = 0.25;  // of half the span: holds the rest of a ball
    const Layers whole{mesh.box.lower[axis], mesh.box.upper[axis]};
    const int inner_layers = mesh.cells[axis] - 2;
    if (inner_layers < 2 || !(span.half() * much < whole.half())) return;
    Layers frame = span;
    frame.widen(margin * span.half());
    frame.widen(2 * frame.half() / inner_layers);
    frame = {std::max(frame.lower, whole.lower), std::min(frame.upper, whole.upper)};
    const double length = frame.upper * mesh.scale[axis] - frame.lower * mesh.scale[axis];
    const double cells_per_length = mesh.cells[axis] / length;
    if (!(length > 0 && std::isfinite(cells_per_length))) return;
    mesh.frame.lower[axis] = frame.lower;
    mesh.frame.upper[axis] = frame.upper;
    mesh.cells_per_length[axis] = cells_per_length;
}

}  // namespace

SupportMesh make_framed_mesh(PointPasses& points, const Box& box, int cells_per_axis) {
    SupportMesh mesh = make_support_mesh(box, points.dimension(), cells_per_axis);
    if (points.count() < sample_size) return mesh;
    const PointSample sample = points.sample(sample_size);
    for (int a = 0; a < points.dimension(); ++a)
        frame_axis(span_of(sample, a), static_cast<std::size_t>(a), mesh);
    return mesh;
}

}  // namespace rrcb
