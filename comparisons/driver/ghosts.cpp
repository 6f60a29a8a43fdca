// Counts the ghosts of the parts of several methods and prints CSV on standard output.
//
// On one process:
//   rrcb_ghosts clouds [--quick]   clouds of 20,000 points, several seeds
// On several:
//   rrcb_ghosts loads [--quick]    loads of the ranks with corrected part sizes
//
// A point is a ghost of a part if it is within three times the radius of GhostCounter.
#include "cloud.hpp"
#include "failure.hpp"
#include "ghost_study_mpi.hpp"
#include "ghosts_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "row.hpp"

#include <rrcb/rrcb.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace {

using namespace comparisons;
using rrcb::Part;

constexpr const char* lammps_axes = "LAMMPS' axes";  ///< a method of this study only

/// Halves the points recursively across the axis for which the narrower half is widest, like
/// LAMMPS.
class WidestHalves {
  public:
    WidestHalves(const rrcb::Points& points, int num_parts)
        : points_(points), parts_(points.count) {
        std::vector<std::size_t> all(points.count);
        std::iota(all.begin(), all.end(), std::size_t{0});
        divide(all, rrcb::bounding_box(points), 0, num_parts);
    }

    const std::vector<Part>& parts() const { return parts_; }

  private:
    double at(std::size_t point, std::size_t axis) const { return points_.position(point)[axis]; }

    /// Moves the `below` points with the smallest coordinates to the front. Returns the cut.
    double select(std::span<std::size_t> ids, std::size_t below, std::size_t axis) const {
        const auto middle = ids.begin() + static_cast<std::ptrdiff_t>(below);
        std::ranges::nth_element(ids, middle, {}, [&](std::size_t i) { return at(i, axis); });
        return at(*middle, axis);
    }

    void divide(std::span<std::size_t> ids, const rrcb::Box& box, Part first, int num_parts) {
        if (num_parts == 1 || ids.empty()) {
            for (const std::size_t i : ids) parts_[i] = first;
            return;
        }
        const int half = num_parts / 2;
        const std::size_t below =
            ids.size() * static_cast<std::size_t>(half) / static_cast<std::size_t>(num_parts);
        std::size_t best = 0;
        double widest = -1;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(points_.dimension); ++axis) {
            const double cut = select(ids, below, axis);
            const double width = std::min(cut - box.lower[axis], box.upper[axis] - cut);
            if (width > widest) best = axis;
            widest = std::max(widest, width);
        }
        rrcb::Box lower = box;
        rrcb::Box upper = box;
        lower.upper[best] = upper.lower[best] = select(ids, below, best);
        divide(ids.first(below), lower, first, half);
        divide(ids.subspan(below), upper, first + half, num_parts - half);
    }

    rrcb::Points points_;
    std::vector<Part> parts_;
};

std::vector<Part> by(const std::string& method, const Workload& workload, int num_parts) {
    if (method == lammps_axes) return WidestHalves(workload.points(), num_parts).parts();
    const Method read = read_method(method);
    if (read.options) {
        auto options = std::get<rrcb::Options>(*read.options);
        options.num_parts = num_parts;
        return rrcb::balance(workload.points(), MPI_COMM_SELF, options).parts;
    }
    ZoltanParameters parameters = zoltan_parameters(read, Lists::parts);
    parameters.emplace_back("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    parameters.emplace_back("IMBALANCE_TOL", "1.01");
    ZoltanPartitioner zoltan(parameters, workload, MPI_COMM_SELF);
    if (zoltan.partition() != ZOLTAN_OK) throw Failure("Zoltan failed");
    return zoltan.parts();
}

void compare(const Cloud& cloud) {
    const Workload workload{
        cloud.name, "", cloud.dimension, cloud_points(cloud, 0, cloud.num_points), false, {}};
    const double radius = ghost_reach * GhostCounter(workload, {}, MPI_COMM_SELF).radius();
    const GhostCounter counter(workload, {radius}, MPI_COMM_SELF);
    for (const int num_parts : {4, 16, 64})
        for (const char* method : {"zoltan-rcb", "zoltan-rib", "zoltan-hsfc", "rrcb-arrays",
                                   "rrcb-arrays[axes=longest]", lammps_axes}) {
            const std::vector<Part> parts = by(method, workload, num_parts);
            const Ghosts ghosts = counter.count(parts, num_parts);
            print(Row()
                      .add("cloud", cloud.name)
                      .add("dim", cloud.dimension)
                      .add("parts", num_parts)
                      .add("seed", cloud.seed)
                      .add("method", method)
                      .add("ghosts", ghosts.sum)
                      .add("ghosts_max", ghosts.most)
                      .add("neighbours_max", ghosts.most_neighbours));
        }
}

void compare_clouds(bool quick) {
    for (const char* name : ghost_clouds())
        for (const int dimension : {2, 3})
            for (std::uint64_t seed = 1; seed <= (quick ? 1 : 5); ++seed)
                compare({name, quick ? 1000 : ghost_points, dimension, seed});
}

}  // namespace

namespace comparisons {

std::span<const char* const> ghost_clouds() {
    static constexpr std::array names{"uniform",  "slab",  "slope",  "run_out",  "polygon", "wave",
                                      "clusters", "shell", "spiral", "diagonal", "cusps",   "drops",
                                      "pile",     "jets",  "web",    "discs"};
    return names;
}

}  // namespace comparisons

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    float version = 0;
    Zoltan_Initialize(argc, argv, &version);
    int exit_code = 0;
    const std::vector<std::string> words(argv + 1, argv + argc);
    const bool quick = !words.empty() && words.back() == "--quick";
    try {
        if (!words.empty() && words[0] == "clouds") {
            compare_clouds(quick);
        } else if (!words.empty() && words[0] == "loads") {
            compare_loads(quick, MPI_COMM_WORLD);
        } else {
            throw Failure("unknown words; see the source for those that it takes");
        }
    } catch (const std::exception& error) {
        std::cerr << "rrcb_ghosts: " << error.what() << '\n';
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
