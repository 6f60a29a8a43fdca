#include "output/history_mpi.hpp"
#include "output/probe_table_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace mpm::test {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& path) {
    std::ifstream file(path);
    Rows rows;
    for (std::string line, entry; std::getline(file, line);) {
        std::istringstream text(line);
        for (rows.emplace_back(); std::getline(text, entry, ',');) rows.back().push_back(entry);
    }
    return rows;
}

/// Rows that a table of a scene gets, at its start and after some steps; on rank 0.
template <class Table>
Rows recorded(const Scene& scene, double end_time) {
    const std::string path = (std::filesystem::temp_directory_path() /
                              ("table_" + std::to_string(size_of(MPI_COMM_WORLD)) + ".csv"))
                                 .string();
    {
        Simulation simulation(scene, MPI_COMM_WORLD);
        Table table(path, scene, MPI_COMM_WORLD);
        table.write(simulation);
        while (simulation.time() < end_time) simulation.step();
        table.write(simulation);
    }
    const Rows rows = rank_of(MPI_COMM_WORLD) == 0 ? rows_of(path) : Rows{};
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_of(MPI_COMM_WORLD) == 0) std::filesystem::remove(path);
    return rows;
}

double number(const Rows& rows, std::size_t row, const std::string& column) {
    const auto at = std::ranges::find(rows.front(), column) - rows.front().begin();
    return std::stod(rows[row][static_cast<std::size_t>(at)]);
}

// Free motion with a uniform rate of strain: position grows by x exp(rate t), and stress by E rate
// t, as nu is 0.
TEST(ProbeTable, follows_points_through_a_uniform_strain) {
    constexpr double rate = 1e-3, modulus = 1e-6;
    Scene scene = axial_bar();
    scene.materials = {elastic_material("rubber", 1, modulus, 0)};
    scene.bodies[0].velocity = [](const Vector& at) { return Vector{rate * at[0], 0, 0}; };
    scene.probes = {{"middle", {10.1, 0.4}}, {"end", {99, 0}}, {"again", {10.3, 0.3}}};
    const double t = 2;
    const Rows rows = recorded<ProbeTable>(scene, t);
    if (rank_of(MPI_COMM_WORLD) != 0) return;
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows[1][2], "middle");
    EXPECT_EQ(rows[6][2], "again");
    EXPECT_EQ(number(rows, 1, "x"), 10.25);
    EXPECT_EQ(number(rows, 1, "y"), 0.25);
    EXPECT_EQ(number(rows, 2, "x"), 24.75);
    EXPECT_EQ(number(rows, 1, "displacement_x"), 0);
    const double time = number(rows, 4, "time");
    EXPECT_GE(time, t);
    for (const std::size_t row : {4u, 5u, 6u}) {
        const double start = row == 5 ? 24.75 : 10.25;
        EXPECT_NEAR(number(rows, row, "displacement_x"), start * rate * time, 1e-4 * start);
        // The last nodes know of no points beyond the end, whose strain is less.
        if (row == 5) continue;
        EXPECT_NEAR(number(rows, row, "stress_xx"), modulus * rate * time,
                    1e-2 * modulus * rate * time);
        EXPECT_EQ(number(rows, row, "stress_zx"), 0);
    }
}

TEST(ProbeTable, tells_on_all_ranks_that_it_cannot_be_written) {
    EXPECT_THROW(ProbeTable("/nowhere/probes.csv", axial_bar(), MPI_COMM_WORLD),
                 std::runtime_error);
}

/// Two soft boxes far apart, the left one in steady motion.
Scene boxes_at_rest_and_in_motion(double speed) {
    return {.name = "boxes",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {30, 4}},
            .materials = {elastic_material("rubber", 1, 1e-6, 0)},
            .bodies = {{.contains = box_region({{20, 1}, {22, 3}}), .material = "rubber"},
                       {.contains = box_region({{2, 1}, {4, 3}}),
                        .material = "rubber",
                        .velocity = [=](const Vector&) {
                            return Vector{speed, 0, 0};
                        }}}};
}

TEST(History, tells_the_front_of_what_has_moved_by_more_than_a_cell) {
    constexpr double speed = 2, first_x = 3.75, top_y = 2.75;
    for (const double seconds : {0.4, 3.0}) {
        const Rows rows = recorded<History>(boxes_at_rest_and_in_motion(speed), seconds);
        if (rank_of(MPI_COMM_WORLD) != 0) continue;
        ASSERT_EQ(rows.size(), 3u);
        EXPECT_EQ(number(rows, 1, "front_x"), 0) << "the lower side while there is none";
        const double way = speed * number(rows, 2, "time");
        EXPECT_NEAR(number(rows, 2, "front_x"), way > 1 ? first_x + way : 0, 1e-9);
        EXPECT_NEAR(number(rows, 2, "top_y"), top_y, 1e-9);
        // All but the last of 32 points are 97 % of the mass; the box at rest ends with it.
        EXPECT_NEAR(number(rows, 2, "front_99"), 21.75, 30e-6);
        EXPECT_EQ(number(rows, 2, "left"), 0);
    }
}

}  // namespace
}  // namespace mpm::test
