#include "estimate/mesh.hpp"

#include "cuts/cut_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rrcb {

namespace {

constexpr std::size_t sample_size = 512;
constexpr std::size_t left_out = sample_size / 64;  // points left out at each end of the sample;
                                                    // more than there are strays

/// Interval along an axis that contains most of the points.
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

/// Limits the inner layers of a mesh along an axis to the span of most points, if they become much
/// narrower.
void frame_axis(const Layers& span, std::size_t axis, SupportMesh& mesh) {
    constexpr double much = 4;
    constexpr double margin = 0.25;  // share of half the span that includes the rest of a ball
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

/// Number of cells per axis with which the error of an estimate is about one percent for a few
/// hundred parts.
double fine_cells(int dimension) {
    return dimension == 1 ? 128 : dimension == 2 ? 22 : 10;
}

/// Number of cells per axis above which more cells cost more than they gain, whatever the number of
/// points.
double most_cells_per_axis(int dimension) {
    return dimension == 1 ? 400 : dimension == 2 ? 42 : 15;
}

/// Returns a whole number of cells, at least 1. Allows for the third root of a cube being rounded
/// down.
int whole_cells(double cells) {
    constexpr double above_rounding = 1 + 1e-12;
    return static_cast<int>(std::max(1.0, std::floor(cells * above_rounding)));
}

/// Returns a mesh each of whose cells covers one or more cells of the grid that limits the cuts.
/// The weight between grid lines is then known, which saves 7 % of the rounds. Returns nullopt if
/// the sizes of the grid do not allow it.
std::optional<SupportMesh> mesh_on_lines(const Box& box, int dimension, int most,
                                         const Options& options) {
    SupportMesh mesh = make_support_mesh(box, dimension, 1);
    const auto limits = axis_limits(options);
    for (int a = 0; a < dimension; ++a) {
        if (!limits[a].resolves(std::max(std::abs(box.lower[a]), std::abs(box.upper[a]))))
            return {};
        const double first = limits[a].line_below(box.lower[a]);
        const double num_lines = limits[a].line_below(box.upper[a]) + 1 - first;
        const double together =
            std::ceil(num_lines / std::min<double>(fine_cells(dimension), most));
        const double cells = std::ceil(num_lines / together);
        mesh.box.lower[a] = limits[a].line(first);
        mesh.box.upper[a] = limits[a].line(first + cells * together);
        const double extent = mesh.box.upper[a] * mesh.scale[a] - mesh.box.lower[a] * mesh.scale[a];
        if (!(extent > 0 && std::isfinite(mesh.box.upper[a]) && std::isfinite(mesh.box.lower[a])))
            return {};
        mesh.cells[a] = static_cast<int>(cells);
        mesh.cells_per_length[a] = cells / extent;
    }
    mesh.frame = mesh.box;
    return mesh;
}

/// Makes a mesh whose layers resolve most of the points, however far away a few points are. If a
/// sample of the points spans far less than their box along an axis, the layers divide the span of
/// the sample, without its extremes and with a margin. The two outermost layers reach to the box.
SupportMesh framed_mesh(PointPasses& points, const Box& box, int cells_per_axis) {
    SupportMesh mesh = make_support_mesh(box, points.dimension(), cells_per_axis);
    if (points.count() < sample_size) return mesh;
    const PointSample sample = points.sample(sample_size);
    for (int a = 0; a < points.dimension(); ++a)
        frame_axis(span_of(sample, a), static_cast<std::size_t>(a), mesh);
    return mesh;
}

}  // namespace

int automatic_cells_per_axis(int dimension, LocalIndex num_points, const Options& options) {
    constexpr double least_points_per_cell = 16;
    constexpr double points_per_cell = 800;
    constexpr double least_cells = 64;
    constexpr double cells_per_part = 16;
    const auto count = static_cast<double>(num_points);
    const auto per_axis = [&](double cells) { return std::pow(cells, 1.0 / dimension); };
    const double by_parts = per_axis(std::max(least_cells, cells_per_part * options.num_parts));
    const double by_points = per_axis(count / points_per_cell);
    const double usual = std::max(by_points, std::min(by_parts, fine_cells(dimension)));
    const double filled = per_axis(count / least_points_per_cell);
    const double cells = std::min({most_cells_per_axis(dimension), usual, filled});
    return whole_cells(cells);
}

SupportMesh mesh_by_options(PointPasses& points, const Box& box, const Options& options) {
    const int dimension = points.dimension();
    if (options.expert.cells_per_axis != 0)
        return framed_mesh(points, box, options.expert.cells_per_axis);
    const double fast = std::pow(static_cast<double>(points.most_cells()), 1.0 / dimension);
    const int most = whole_cells(std::min(fast, 1e6));
    if (!options.expert.axes.grid.empty())
        if (const auto mesh = mesh_on_lines(box, dimension, most, options)) return *mesh;
    const int cells = automatic_cells_per_axis(dimension, points.count(), options);
    return framed_mesh(points, box, std::min(most, cells));
}

}  // namespace rrcb
