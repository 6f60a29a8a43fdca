#include "variations.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace mpm::test {
namespace {

/// A file of these ranks, taken away in the end.
class StateFile {
  public:
    StateFile() {
        // Several runs of this test may share a folder.
        int process = getpid();
        MPI_Bcast(&process, 1, MPI_INT, 0, MPI_COMM_WORLD);
        path_ =
            (std::filesystem::temp_directory_path() / ("state_" + std::to_string(process) + ".mpm"))
                .string();
    }
    ~StateFile() {
        MPI_Barrier(MPI_COMM_WORLD);
        if (rank_of(MPI_COMM_WORLD) == 0) std::filesystem::remove(path_);
    }
    StateFile(const StateFile&) = delete;
    StateFile& operator=(const StateFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

void advance(Simulation& simulation, int num_steps) {
    for (int step = 0; step < num_steps; ++step) simulation.step();
}

/// Cuts that no slabs have, so that a restart must bring the boxes with it.
Balancer uneven(double lower, double width) {
    return [=](Positions, MPI_Comm comm) {
        std::vector<double> cuts;
        const int size = size_of(comm);
        for (int k = 1; k < size; ++k) cuts.push_back(lower + width * k * k / (size * size));
        return between_cuts(cuts);
    };
}

void expect_same_bits(const Simulation& a, const Simulation& b) {
    EXPECT_EQ(a.time(), b.time());
    EXPECT_EQ(a.time_step(), b.time_step());
    EXPECT_EQ(a.step_count(), b.step_count());
    ASSERT_EQ(a.particles().column_names(), b.particles().column_names());
    for (const std::string& column : a.particles().column_names())
        EXPECT_TRUE(std::ranges::equal(a.particles()[column], b.particles()[column])) << column;
    const Totals of_a = a.totals(), of_b = b.totals();
    EXPECT_EQ(of_a.kinetic_energy, of_b.kinetic_energy);
    EXPECT_EQ(of_a.strain_energy, of_b.strain_energy);
    EXPECT_EQ(a.reports(), b.reports());
}

/// Steps on end, with a rebalance in both halves, beside a stop in the middle.
void expect_same_bits_with_a_stop(const Scene& scene) {
    const StateFile file;
    const Balancer cuts = uneven(scene.grid.lower[0], scene.grid.upper()[0] - scene.grid.lower[0]);
    constexpr int half = 40;
    Simulation whole(scene, MPI_COMM_WORLD);
    advance(whole, 30);
    whole.rebalance(cuts);
    advance(whole, half - 30);
    whole.write_state(file.path());
    Simulation continued(scene, file.path(), MPI_COMM_WORLD);
    expect_same_bits(whole, continued);
    for (Simulation* simulation : {&whole, &continued}) {
        advance(*simulation, 20);
        simulation->rebalance(cuts);
        advance(*simulation, half - 20);
    }
    expect_same_bits(whole, continued);
}

/// An elastic block that slides on a wall, which gives way to it.
Scene sliding_block(ShapeFunction shape) {
    Scene scene = flying_disk();
    scene.bodies.front().contains = box_region({{2, 0}, {6, 2}});
    scene.bodies.front().velocity = velocity_field({.constant = {8, 0}});
    scene.shape_function = shape;
    scene.walls.bottom = {Wall::frictional, 0.3};
    scene.effects = {gravity_effect(9.81)};
    return scene;
}

TEST(State, goes_on_with_the_same_bits) {
    expect_same_bits_with_a_stop(coarse_slope());
    expect_same_bits_with_a_stop(shipped("torpedo_anchor", 0.375));
    expect_same_bits_with_a_stop(shipped("submarine_slide", 2.5));
    Scene disk = flying_disk();
    disk.shape_function = ShapeFunction::quadratic;
    expect_same_bits_with_a_stop(disk);
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic})
        expect_same_bits_with_a_stop(sliding_block(shape));
}

/// The same scene on this rank alone, without a stop, beside a state of one number of ranks that
/// another number goes on from.
void expect_same_on_other_ranks(const Scene& scene, const std::string& column) {
    const StateFile file;
    constexpr int half = 40;
    Simulation serial(scene, MPI_COMM_SELF);
    advance(serial, half);
    if (rank_of(MPI_COMM_WORLD) == 0) serial.write_state(file.path());
    MPI_Barrier(MPI_COMM_WORLD);
    Simulation first(scene, file.path(), MPI_COMM_WORLD);
    advance(first, half);
    first.write_state(file.path());
    Simulation second(scene, file.path(), MPI_COMM_SELF);
    MPI_Barrier(MPI_COMM_WORLD);
    for (Simulation* simulation : {&serial, &second}) advance(*simulation, half);
    advance(serial, half);
    EXPECT_LT(relative_difference(gathered(serial, column, MPI_COMM_SELF),
                                  gathered(second, column, MPI_COMM_SELF)),
              1e-13);
    EXPECT_NEAR(total_energy(serial), total_energy(second), 1e-13 * std::abs(total_energy(serial)));
    EXPECT_EQ(serial.step_count(), second.step_count());
}

TEST(State, goes_on_on_another_number_of_ranks) {
    expect_same_on_other_ranks(flying_disk(), "x");
    expect_same_on_other_ranks(sliding_block(ShapeFunction::quadratic), "x");
    expect_same_on_other_ranks(coarse_slope(), "y");
    expect_same_on_other_ranks(shipped("torpedo_anchor", 0.375), "y");
    expect_same_on_other_ranks(shipped("submarine_slide", 2.5), "y");
}

std::string error_of(const Scene& scene, const std::string& path) {
    try {
        const Simulation simulation(scene, path, MPI_COMM_WORLD);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(State, that_does_not_fit_is_refused_on_all_ranks) {
    const StateFile file;
    const Scene scene = flying_disk();
    Simulation(scene, MPI_COMM_WORLD).write_state(file.path());
    EXPECT_EQ(error_of(scene, file.path()), "");
    EXPECT_NE(error_of(coarse_slope(), file.path()).find("another scene"), std::string::npos);
    EXPECT_NE(error_of(scene, "nowhere.mpm").find("no state"), std::string::npos);
    Scene beside = scene;
    beside.bodies.front().contains = ball_region({5, 4}, 2);
    EXPECT_NE(error_of(beside, file.path()).find("other bodies"), std::string::npos)
        << "as many points in another place";
    Simulation(scene, MPI_COMM_WORLD).write_state(file.path());
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD).write_state("/nowhere/state.mpm"),
                 std::runtime_error);
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_of(MPI_COMM_WORLD) == 0)
        std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 8);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_NE(error_of(scene, file.path()).find("too early"), std::string::npos);
}

}  // namespace
}  // namespace mpm::test
