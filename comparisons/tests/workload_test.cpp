#include "../../tests/support/ranks.hpp"
#include "failure.hpp"
#include "workload_mpi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace comparisons {
namespace {

std::vector<int> counts_of_all(std::size_t mine) {
    const int count = static_cast<int>(mine);
    std::vector<int> counts(static_cast<std::size_t>(rrcb::test::num_ranks()));
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    return counts;
}

/// Returns the points of all ranks in lexicographic order, on every rank.
std::vector<std::array<double, 3>> all_points(const Workload& workload) {
    const rrcb::Points points = workload.points();
    std::vector<double> mine;
    for (std::size_t i = 0; i < points.count; ++i) {
        const rrcb::Vector x = points.position(i);
        mine.insert(mine.end(), x.begin(), x.end());
    }
    const std::vector<int> counts = counts_of_all(mine.size());
    std::vector<int> starts(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    std::vector<std::array<double, 3>> all(static_cast<std::size_t>(starts.back() + counts.back()) /
                                           3);
    MPI_Allgatherv(mine.data(), counts[static_cast<std::size_t>(rrcb::test::rank())], MPI_DOUBLE,
                   all.data(), counts.data(), starts.data(), MPI_DOUBLE, MPI_COMM_WORLD);
    std::ranges::sort(all);
    return all;
}

TEST(Workload, holds_the_same_points_at_any_number_of_ranks) {
    for (const char* name : {"uniform", "slope", "clusters", "lattice"}) {
        for (const Layout layout : {Layout::sorted, Layout::scattered}) {
            for (const int dimension : {2, 3}) {
                const Cloud cloud{name, 1003, dimension, 5};
                Workload serial;
                serial.dimension = dimension;
                if (rrcb::test::rank() == 0)
                    serial.coordinates = cloud_points(cloud, 0, cloud.num_points);
                EXPECT_EQ(all_points(cloud_workload(cloud, layout, MPI_COMM_WORLD)),
                          all_points(serial))
                    << name << ' ' << layout_name(layout) << ' ' << dimension;
            }
        }
    }
}

TEST(Workload, sorted_pieces_are_equal_and_follow_the_curve) {
    const Workload workload =
        cloud_workload({"uniform", 4000, 2, 1}, Layout::sorted, MPI_COMM_WORLD);
    const std::vector<int> counts = counts_of_all(workload.points().count);
    const auto [fewest, most] = std::ranges::minmax(counts);
    EXPECT_LE(most - fewest, 1);

    const std::vector<std::array<double, 3>> all = all_points(workload);
    rrcb::Box box{all.front(), all.front()};
    for (const auto& x : all) {
        for (std::size_t a = 0; a < 2; ++a) {
            box.lower[a] = std::min(box.lower[a], x[a]);
            box.upper[a] = std::max(box.upper[a], x[a]);
        }
    }
    const rrcb::Points points = workload.points();
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < points.count; ++i) {
        places.push_back(hilbert_cell(box, points.position(i), 2, hilbert_bits(2)));
    }
    EXPECT_TRUE(std::ranges::is_sorted(places));
    std::uint64_t last_before = 0;
    const std::uint64_t last = places.back();
    MPI_Exscan(&last, &last_before, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LE(rrcb::test::rank() == 0 ? 0 : last_before, places.front());
}

TEST(Workload, neighbours_on_the_curve_are_neighbours_in_space) {
    for (const int dimension : {2, 3}) {
        const int side = 1 << hilbert_bits(dimension);
        const double upper = side;
        const rrcb::Box box{{0, 0, 0}, {upper, upper, upper}};
        std::vector<std::array<int, 3>> cells(hilbert_cells(dimension), {-1, -1, -1});
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) {
                for (int z = 0; z < (dimension == 3 ? side : 1); ++z) {
                    cells[hilbert_cell(box, {x + 0.5, y + 0.5, z + 0.5}, dimension,
                                       hilbert_bits(dimension))] = {x, y, z};
                }
            }
        }
        for (std::size_t i = 1; i < cells.size(); ++i) {
            int distance = 0;
            for (std::size_t a = 0; a < 3; ++a) distance += std::abs(cells[i][a] - cells[i - 1][a]);
            ASSERT_EQ(distance, 1) << "place " << i << " in " << dimension << "-D";
        }
    }
}

TEST(Workload, weights_of_a_file_travel_with_their_points) {
    const std::string file =
        testing::TempDir() + "rrcb_weights_" + std::to_string(rrcb::test::num_ranks()) + ".csv";
    if (rrcb::test::rank() == 0) {
        std::ofstream out(file);
        out << "x,y,weight\n";
        for (int i = 0; i < 50; ++i) out << i << ',' << -i << ',' << 2 * i << '\n';
    }
    for (const Layout layout : {Layout::sorted, Layout::scattered}) {
        const Workload workload = file_workload(file, layout, 1, MPI_COMM_WORLD);
        const std::vector<int> counts = counts_of_all(workload.points().count);
        EXPECT_EQ(std::reduce(counts.begin(), counts.end()), 50);
        ASSERT_EQ(workload.weights.size(), workload.points().count);
        for (std::size_t i = 0; i < workload.weights.size(); ++i) {
            EXPECT_EQ(workload.weights[i], 2 * workload.points().coordinate(i, 0));
        }
    }
}

TEST(Workload, a_missing_file_fails_on_every_rank) {
    EXPECT_THROW(file_workload("no such file", Layout::sorted, 1, MPI_COMM_WORLD), Failure);
}

/// Writes a dump of three ranks with 1, 3 and 2 points. The points are (0, 0), (1, -1), ... and
/// their weights are 1, 2, ...
void write_dump(const std::string& folder) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/call.txt") << "rrcb-dump 1\nfunction f\nranks 3\nend\n";
    const int counts[] = {1, 3, 2};
    int next = 0;
    for (int rank = 0; rank < 3; ++rank) {
        std::ofstream out(folder + "/rank-" + std::to_string(rank) + ".txt");
        out << "rrcb-dump-rank 1\nrank " << rank << "\ndimension 2\nweights 1\nobjects "
            << counts[rank] << '\n';
        for (const int end = next + counts[rank]; next < end; ++next)
            out << next << ' ' << -next << ' ' << next + 1 << '\n';
        out << "end\n";
    }
}

TEST(Workload, of_a_dump_is_where_it_was_or_dealt_out_in_order) {
    const int n = rrcb::test::num_ranks();
    const std::string folder = testing::TempDir() + "rrcb_dump_np" + std::to_string(n);
    if (rrcb::test::rank() == 0) write_dump(folder);
    const auto [workload, note] = read_replay(folder + '/', MPI_COMM_WORLD);
    EXPECT_EQ(workload.name, "rrcb_dump_np" + std::to_string(n));
    EXPECT_EQ(workload.layout, n == 3 ? "dump" : "dealt");
    const std::vector<int> counts = counts_of_all(workload.points().count);
    const std::vector<int> expected[] = {{6}, {3, 3}, {1, 3, 2}, {1, 2, 1, 2}};
    EXPECT_EQ(counts, expected[n - 1]);
    int next = std::reduce(counts.begin(), counts.begin() + rrcb::test::rank());
    for (std::size_t i = 0; i < workload.weights.size(); ++i, ++next) {
        EXPECT_EQ(workload.points().position(i), (rrcb::Vector{1.0 * next, -1.0 * next, 0}));
        EXPECT_EQ(workload.weights[i], next + 1);
    }
    if (rrcb::test::rank() == 0) {
        EXPECT_EQ(note.find("dealt out in order to") == note.npos, n == 3);
    }
}

}  // namespace
}  // namespace comparisons
