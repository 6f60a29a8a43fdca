#include "balancers/balancers_mpi.hpp"
#include "variations.hpp"
#include "words.hpp"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace mpm::test {
namespace {

constexpr int num_steps = 40;
constexpr int every = 5;  // steps between rebalances
constexpr double round_off = 1e-12;

constexpr std::array<const char*, 5> balancers{"none", "rrcb", "rrcb-exact", "rrcb-sampled",
                                               "root-rcb"};

constexpr std::array<const char*, 1> usual{"rrcb"};

/// A shipped scene in larger cells, in full weight from its first step.
Scene in_full_weight(const std::string& name, double cell_size) {
    Scene scene = shipped(name, cell_size);
    if (Parameters* gravity = find_effect(scene, "gravity")) gravity->erase("ramp");
    return scene;
}

/// Columns of all points, and all that a simulation tells of itself.
struct State {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
    std::vector<double> totals;
    std::vector<double> reports;
};

State state_of(const Simulation& simulation, MPI_Comm comm) {
    State state;
    state.names = simulation.particles().column_names();
    for (const std::string& name : state.names)
        state.columns.push_back(gathered(simulation, name, comm));
    const Totals totals = simulation.totals();
    state.totals = {totals.kinetic_energy, totals.strain_energy, totals.potential_energy};
    for (const auto& [name, value] : simulation.reports()) state.reports.push_back(value);
    return state;
}

State run(const Scene& scene, const std::optional<Balancer>& balancer, MPI_Comm comm) {
    Simulation simulation(scene, comm);
    for (int step = 0; step < num_steps; ++step) {
        if (balancer && step % every == 0) simulation.rebalance(*balancer);
        simulation.step();
    }
    return state_of(simulation, comm);
}

State run(const Scene& scene, const char* name, MPI_Comm comm) {
    return run(scene, make_balancer(name, scene), comm);
}

/// The name of a tensor or vector, of which a column is a component.
std::string stem(const std::string& name) {
    return name.substr(0, name.rfind('_'));
}

/// The components of a tensor have one scale: the largest entry of all of them.
void expect_same(const State& a, const State& b) {
    ASSERT_EQ(a.names, b.names);
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> tensors;
    for (std::size_t c = 0; c < a.columns.size(); ++c) {
        auto& [of_a, of_b] = tensors[stem(a.names[c])];
        of_a.insert(of_a.end(), a.columns[c].begin(), a.columns[c].end());
        of_b.insert(of_b.end(), b.columns[c].begin(), b.columns[c].end());
    }
    tensors["totals"] = {a.totals, b.totals};
    tensors["reports"] = {a.reports, b.reports};
    for (const auto& [name, both] : tensors) {
        if (both.first == both.second) continue;
        EXPECT_LT(relative_difference(both.first, both.second), round_off) << name;
    }
}

void expect_serial_under(std::span<const char* const> names, const Scene& scene) {
    const State serial = run(scene, "none", MPI_COMM_SELF);
    for (const char* name : names) {
        SCOPED_TRACE(scene.name + " under " + name);
        expect_same(serial, run(scene, name, MPI_COMM_WORLD));
    }
}

TEST(Balancers, do_not_show_in_soil_that_fails) {
    Scene scene = in_full_weight("slope", 4);
    scene.materials.front().parameters["cohesion"] = 1e3;
    scene.materials.front().parameters["tension_cut_off"] = 1e3;
    scene.effects.push_back({"damping", {{"rate", 0.3}, {"until", 0.2}}});
    expect_serial_under(balancers, scene);
}

TEST(Balancers, do_not_show_where_many_ranks_make_the_parts) {
    rrcb::Options options;
    options.expert.max_root_parts = 2;
    const Scene scene = in_full_weight("slope", 4);
    expect_same(run(scene, "none", MPI_COMM_SELF),
                run(scene, rrcb_balancer(options), MPI_COMM_WORLD));
}

TEST(Balancers, do_not_show_under_water_where_clay_softens_and_is_dragged) {
    Scene scene = in_full_weight("submarine_slide", 4);
    scene.materials.front().parameters["strength"] = 1e3;
    scene.materials.front().parameters["softening_strain"] = 0.01;
    scene.bodies.front().velocity = velocity_field({.constant = {3, 0}});
    expect_serial_under(usual, scene);
}

TEST(Balancers, do_not_show_where_a_penetrator_strikes) {
    expect_serial_under(usual, in_full_weight("torpedo_anchor", 0.375));
}

TEST(Balancers, do_not_show_in_large_strains_and_wide_shape_functions) {
    Scene scene = in_full_weight("elastic_structure", 0.25);
    scene.bodies.front().velocity = [](const Vector& at) {
        return Vector{0, 0.1 * at[0] * at[0], 0};
    };
    expect_serial_under(usual, scene);
}

TEST(Balancers, do_not_show_in_sand_that_parts_or_bodies_that_meet) {
    Scene disks = in_full_weight("two_disks", 0.05);
    for (Body& body : disks.bodies) {
        const Region contains = body.contains;
        const double offset = &body == &disks.bodies.front() ? -0.15 : 0.15;
        body.bounds = everywhere;
        body.contains = [=](const Vector& at) {
            return contains({at[0] + offset, at[1] + offset});
        };
    }
    disks.courant_number = 0.5;
    expect_serial_under(usual, disks);
    expect_serial_under(usual, in_full_weight("granular_column", 0.2));
}

TEST(Balancers, do_not_show_in_water_that_strikes_a_wall) {
    Scene scene = in_full_weight("dam_break", 0.1);
    scene.bodies.front().contains = box_region({{3.95, 0}, {5.95, 1}});
    scene.bodies.front().bounds = everywhere;
    scene.bodies.front().velocity = velocity_field({.constant = {6, 0}});
    expect_serial_under(usual, scene);
}

TEST(Balancers, do_not_show_on_an_inclined_plane) {
    Scene scene = in_full_weight("incline_block", 0.25);
    scene.bodies.front().velocity = velocity_field({.constant = {4, -2}});
    expect_serial_under(usual, scene);
}

/// Whether a face lies on a line of the grid or ends just below one.
bool ends_at_cell(const GridShape& grid, double face, std::size_t axis) {
    const double k = std::round((face - grid.lower[axis]) / grid.spacing);
    const double line = grid.lower[axis] + k * grid.spacing;
    return face == line || face == std::nextafter(line, -HUGE_VAL);
}

TEST(Balancers, of_cells_cut_on_faces_and_do_not_show) {
    for (const ShapeFunction function : {ShapeFunction::linear, ShapeFunction::quadratic}) {
        Scene scene = in_full_weight("slope", 2);
        scene.shape_function = function;
        const int num_nodes = function == ShapeFunction::linear ? 2 : 3;
        expect_same(run(scene, "none", MPI_COMM_SELF), run(scene, "rrcb-cells", MPI_COMM_WORLD));
        Simulation simulation(scene, MPI_COMM_WORLD);
        simulation.rebalance(*make_balancer("rrcb", scene));
        simulation.step();
        const std::int64_t anywhere = simulation.totals().num_ghost_nodes;
        simulation.rebalance(*make_balancer("rrcb-cells", scene));
        simulation.step();
        const std::int64_t on_faces = simulation.totals().num_ghost_nodes;
        EXPECT_LT(on_faces, anywhere);
        for (const Box& box : simulation.decomposition().boxes) {
            for (std::size_t a = 0; a < 2; ++a) {
                for (const double face : {box.lower[a], box.upper[a]})
                    EXPECT_TRUE(std::isinf(face) || ends_at_cell(scene.grid, face, a)) << face;
                if (std::isfinite(box.lower[a]) && std::isfinite(box.upper[a])) {
                    EXPECT_GE(box.upper[a] - box.lower[a],
                              num_nodes * scene.grid.spacing * (1 - 1e-12));
                }
            }
        }
    }
}

TEST(Balancers, of_an_unknown_name_are_refused_with_the_known_ones) {
    expect_refused([] { make_balancer("magic"); }, {"choose from: none, rrcb, rrcb-exact"});
}

/// A ball in space that leaves through a side after some steps.
Scene leaving_ball() {
    return {.name = "leaving",
            .dimension = 3,
            .grid = {.lower = {0, 0, 0}, .spacing = 0.25, .num_cells = {8, 8, 6}},
            .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
            .bodies = {{.contains = ball_region({0.5, 1, 0.75}, 0.3),
                        .material = "rubber",
                        .velocity = velocity_field({.constant = {-30, 0, 0}})}}};
}

// Ranks without points know no dimension by their columns.
TEST(Balancers, divide_no_points_in_space) {
    for (const char* name : balancers) {
        Simulation simulation(leaving_ball(), MPI_COMM_WORLD);
        const std::optional<Balancer> balancer = make_balancer(name, leaving_ball());
        while (simulation.totals().num_points > 0) {
            simulation.step();
            if (balancer) simulation.rebalance(*balancer);
        }
        for (int step = 0; step < 3; ++step) {
            simulation.step();
            if (balancer) simulation.rebalance(*balancer);
        }
        EXPECT_EQ(simulation.totals().num_points, 0) << name;
    }
}

}  // namespace
}  // namespace mpm::test
