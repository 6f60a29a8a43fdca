// Kinds of statistical domain at equal bytes into the root, as CSV on standard output; several rows
// of one cloud are several seeds, of a scene several of its moments.
//
//   rrcb_domains [--quick]     with --quick: few points, one seed, one coarse scene
#include "cloud.hpp"
#include "domain_comparison.hpp"
#include "moving_points_mpi.hpp"

#include <mpi.h>

#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace comparisons;

constexpr int num_repeats = 5;

/// One more than the layers below, each of ten times the weight of the one before.
std::vector<double> weights_of_layers(const std::vector<double>& coordinates, int dimension) {
    constexpr double thickness = 20;
    std::vector<double> weights;
    for (std::size_t i = 0; i < coordinates.size(); i += static_cast<std::size_t>(dimension)) {
        double weight = 1;
        for (double height = thickness; height < coordinates[i + 1]; height += thickness)
            weight *= 10;
        weights.push_back(weight);
    }
    return weights;
}

DomainCase cloud_case(const std::string& name, int dimension, std::uint64_t seed, bool quick) {
    const rrcb::GlobalCount num_points = quick ? 20'000 : 200'000;
    const bool is_layered = name == "layers";
    DomainCase points{name, dimension, {}, {}};
    points.coordinates =
        cloud_points({is_layered ? "uniform" : name, num_points, dimension, seed}, 0, num_points);
    if (is_layered) points.weights = weights_of_layers(points.coordinates, dimension);
    return points;
}

DomainCase scene_case(const std::string& scene, const mpm::Positions& at) {
    DomainCase points{"scene " + scene, at.z.empty() ? 2 : 3, {}, {}};
    for (std::size_t i = 0; i < at.size(); ++i) {
        points.coordinates.insert(points.coordinates.end(), {at.x[i], at.y[i]});
        if (points.dimension == 3) points.coordinates.push_back(at.z[i]);
    }
    return points;
}

void print(const std::vector<Row>& rows) {
    for (const Row& row : rows) std::cout << row.text() << '\n';
    std::cout.flush();
}

void compare_clouds(bool quick) {
    for (const char* name : {"slope", "run_out", "polygon", "clusters", "shell", "spiral", "layers",
                             "uniform", "lattice"})
        for (const int dimension : {2, 3})
            for (int seed = 1; seed <= (quick ? 1 : num_repeats); ++seed)
                print(domain_rows(
                    cloud_case(name, dimension, static_cast<std::uint64_t>(seed), quick), quick));
}

/// Moments from a fifth of the way to the end of the scene.
void compare_scene(const std::string& scene, bool quick) {
    const auto points = scene_points(scene, quick, MPI_COMM_SELF);
    const int num_steps = quick ? 100 : points->num_steps();
    for (int step = 1; step <= num_steps; ++step) {
        points->step();
        if (step * num_repeats / num_steps > (step - 1) * num_repeats / num_steps)
            print(domain_rows(scene_case(scene, points->positions()), quick));
    }
}

void compare(bool quick) {
    std::cout << domain_columns().header() << '\n';
    compare_clouds(quick);
    for (const char* scene :
         {"slope", "submarine_slide", "anchor_plate", "dam_break", "elastic_structure"}) {
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
