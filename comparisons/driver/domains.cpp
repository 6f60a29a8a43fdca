// Kinds of statistical domain at equal bytes into the root, as CSV on standard output; several rows
// of one cloud are several seeds, of a scene several of its moments.
//
//   rrcb_domains [--quick]     with --quick: few points, one seed, one coarse scene
#include "cloud.hpp"
#include "gather/lean_cells.hpp"
#include "row.hpp"
#include "scene_choice_mpi.hpp"
#include "scene_mpi.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <cmath>
#include <exception>
#include <iostream>
#include <string_view>

namespace {

using namespace comparisons;
using rrcb::CellMoments;
using rrcb::Points;
using rrcb::StatisticalDomain;

constexpr int num_repeats = 5;

/// A kind of statistical domain, as the cells of one mesh make it.
struct DomainKind {
    std::string name;
    int (*bytes_per_cell)(int dimension);  ///< of what the root needs of a cell
    StatisticalDomain (*make)(const Points& points, int cells_per_axis);
};

std::vector<CellMoments> cells_of(const Points& points, int cells_per_axis) {
    return rrcb::cell_moments(points, rrcb::make_support_mesh(rrcb::bounding_box(points),
                                                              points.dimension, cells_per_axis));
}

/// A uniform patch in mean +- sqrt(3) sigma per cell, wherever the cell ends.
StatisticalDomain boxes(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension};
    for (const CellMoments& cell : cells_of(points, cells_per_axis)) {
        rrcb::Patch patch{{}, {}, cell.moments.weight};
        for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
            patch.lower[a] = cell.moments.mean[a] - std::sqrt(3.0) * cell.moments.deviation[a];
            patch.upper[a] = cell.moments.mean[a] + std::sqrt(3.0) * cell.moments.deviation[a];
        }
        domain.patches.push_back(patch);
    }
    return domain;
}

/// Of moments as lean records bring them to the root.
StatisticalDomain analytic(const Points& points, int cells_per_axis) {
    const rrcb::Box box = rrcb::bounding_box(points);
    const auto mesh = rrcb::make_support_mesh(box, points.dimension, cells_per_axis);
    const std::vector<CellMoments> cells = rrcb::cell_moments(points, mesh);
    const rrcb::LeanCells packed = rrcb::pack_cells(cells, mesh);
    std::vector<CellMoments> lean;
    rrcb::unpack_cells(packed, packed.bytes, cells.size(), mesh, lean);
    return rrcb::analytic_domain(lean, points.dimension, box);
}

StatisticalDomain counts(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension};
    for (const CellMoments& cell : cells_of(points, cells_per_axis))
        domain.patches.push_back({cell.box.lower, cell.box.upper, cell.moments.weight, {}, {}});
    return domain;
}

/// The paper's: as many points as there are, in 1.5 sigma.
StatisticalDomain samples(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension};
    for (const auto& [position, weight] : rrcb::sample_points(
             cells_of(points, cells_per_axis), points.dimension, rrcb::PaperOptions()))
        domain.patches.push_back({position, position, weight});
    return domain;
}

/// The true shares of sub-cells, which no guess within cells of that size can do better than.
StatisticalDomain floor_of(const Points& points, int cells_per_axis) {
    return counts(points, cells_per_axis * (points.dimension == 2 ? 8 : 4));
}

int full_record(int dimension) {
    return 8 * (3 + 2 * dimension);
}

int lean_record(int dimension) {
    return 4 + 2 * dimension;
}

const DomainKind kinds[] = {
    {"box", full_record, boxes},
    {"analytic", lean_record, analytic},
    {"counts", [](int) { return 4; }, counts},
    {"samples", full_record, samples},
    {"floor", [](int) { return 4 * 64; }, floor_of},
};

/// Cells per axis for as many bytes as lean records of a mesh take. The floor is that of the cells
/// of lean records.
int cells_for(const DomainKind& kind, int lean_cells_per_axis, int dimension) {
    if (kind.make == floor_of) return lean_cells_per_axis;
    const double ratio =
        static_cast<double>(lean_record(dimension)) / kind.bytes_per_cell(dimension);
    const double cells = lean_cells_per_axis * std::pow(ratio, 1.0 / dimension);
    return std::max(1, static_cast<int>(std::lround(cells)));
}

double measured_imbalance(const Points& points, const StatisticalDomain& domain, int num_parts) {
    const rrcb::Cuts cuts = rrcb::bisect(domain, num_parts, {}).cuts;
    std::vector<rrcb::Part> parts(points.count);
    rrcb::assign(cuts, points, parts);
    std::vector<double> weights(static_cast<std::size_t>(num_parts));
    for (rrcb::LocalIndex i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(parts[i])] += points.weight(i);
    return rrcb::imbalance(weights);
}

std::vector<int> lean_meshes(int dimension, bool quick) {
    if (quick) return {dimension == 2 ? 16 : 6};
    return dimension == 2 ? std::vector{8, 16, 32} : std::vector{4, 7, 12};
}

/// The rows of one set of points: each kind, in 8, 64 and 256 parts, on the meshes of several
/// numbers of bytes. What the root bisects is not refined.
void print_rows(const Workload& workload, bool quick) {
    static bool is_first = true;
    const int dimension = workload.dimension;
    for (const int mesh : lean_meshes(dimension, quick)) {
        for (const DomainKind& kind : kinds) {
            const int per_axis = cells_for(kind, mesh, dimension);
            const StatisticalDomain domain = kind.make(workload.points(), per_axis);
            for (const int num_parts : {8, 64, 256}) {
                const int bytes = kind.bytes_per_cell(dimension);
                const double cells = std::pow(per_axis, dimension);
                const Row row =
                    Row()
                        .add("cloud", workload.name)
                        .add("dim", dimension)
                        .add("parts", num_parts)
                        .add("kind", kind.name)
                        .add("bytes_per_cell", bytes)
                        .add("cells", cells)
                        .add("root_bytes_in", bytes * cells)
                        .add("imbalance", measured_imbalance(workload.points(), domain, num_parts));
                if (std::exchange(is_first, false)) std::cout << row.header() << '\n';
                std::cout << row.text() << std::endl;
            }
        }
    }
}

/// One more than the layers below, each of ten times the weight of the one before.
double weight_of_layer(double height) {
    constexpr double thickness = 20;
    double weight = 1;
    for (double below = thickness; below < height; below += thickness) weight *= 10;
    return weight;
}

Workload cloud_points_of(const std::string& name, int dimension, std::uint64_t seed, bool quick) {
    const rrcb::GlobalCount num_points = quick ? 20'000 : 200'000;
    const bool is_layered = name == "layers";
    Workload points;
    points.name = name;
    points.dimension = dimension;
    points.coordinates =
        cloud_points({is_layered ? "uniform" : name, num_points, dimension, seed}, 0, num_points);
    for (std::size_t i = 1; is_layered && i < points.coordinates.size();
         i += static_cast<std::size_t>(dimension))
        points.weights.push_back(weight_of_layer(points.coordinates[i]));
    return points;
}

/// Moments from a fifth of the way to the end of the scene.
void compare_scene(const std::string& name, bool quick) {
    const mpm::Scene scene = choose_scene(name, quick, MPI_COMM_SELF);
    const int num_steps = quick ? 100 : steps_to_end(scene, MPI_COMM_SELF);
    mpm::Simulation simulation(scene, MPI_COMM_SELF);
    for (int step = 1; step <= num_steps; ++step) {
        simulation.step();
        if (step * num_repeats / num_steps > (step - 1) * num_repeats / num_steps)
            print_rows(snapshot("scene " + name, simulation), quick);
    }
}

void compare(bool quick) {
    for (const char* name : {"slope", "run_out", "polygon", "clusters", "shell", "spiral", "layers",
                             "uniform", "lattice"})
        for (const int dimension : {2, 3})
            for (unsigned seed = 1; seed <= (quick ? 1 : num_repeats); ++seed)
                print_rows(cloud_points_of(name, dimension, seed, quick), quick);
    for (const char* scene : {"slope", "submarine_slide", "dam_break", "elastic_structure"}) {
        compare_scene(scene, quick);
        if (quick) break;
    }
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int exit_code = 0;
    try {
        compare(argc > 1 && std::string_view(argv[1]) == "--quick");
    } catch (const std::exception& error) {
        std::cerr << "rrcb_domains: " << error.what() << '\n';
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
