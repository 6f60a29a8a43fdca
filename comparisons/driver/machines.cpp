// Ghosts between machines, of parts by several ways.
//
// Usage: rrcb_machines MACHINES RANKS_EACH DIMENSION CLOUD SEED POINTS_PER_PART
//
// One process makes all parts, or as many as there are ranks make them and fetch the ghosts. A
// point is a ghost of another part if the box around its points is within twice the mean spacing.
#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "traffic.hpp"

#include <rrcb/rrcb.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using comparisons::Workload;
using comparisons::ZoltanPartitioner;
using rrcb::Part;

struct Case {
    int machines = 1;
    int ranks_each = 1;
    int dimension = 2;
    std::string cloud;
    unsigned seed = 0;
    std::size_t num_points = 0;

    int num_parts() const { return machines * ranks_each; }
    int machine_of(Part part) const { return part / ranks_each; }
    double radius() const {
        return 2 * std::pow(1.0 / static_cast<double>(num_points), 1.0 / dimension);
    }
};

/// A point of a cloud in the unit box, or about it.
class Cloud {
  public:
    explicit Cloud(const Case& of) : of_(of), random_(of.seed) {
        for (Cluster& cluster : clusters_) {
            for (double& x : cluster.centre) x = uniform_(random_);
            cluster.width = 0.02 + 0.1 * uniform_(random_);
        }
    }

    void append_point(std::vector<double>& coordinates) {
        const Cluster& cluster = clusters_[random_() % clusters_.size()];
        for (int axis = 0; axis < of_.dimension; ++axis) {
            const double u = uniform_(random_);
            if (of_.cloud == "uniform") {
                coordinates.push_back(u);
            } else if (of_.cloud == "corner") {
                coordinates.push_back(std::pow(u, 1 + axis));
            } else {
                coordinates.push_back(cluster.centre[axis] + cluster.width * normal_(random_));
            }
        }
    }

  private:
    struct Cluster {
        rrcb::Vector centre{};
        double width = 0;
    };

    const Case& of_;
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> uniform_;
    std::normal_distribution<double> normal_;
    std::array<Cluster, 12> clusters_;
};

/// The points of this rank: every rank draws all and takes its own.
Workload points_here(const Case& of, int rank, int num_ranks) {
    Workload workload{"", "", of.dimension, {}, false, {}};
    Cloud cloud(of);
    std::vector<double> point;
    for (std::size_t i = 0; i < of.num_points; ++i) {
        point.clear();
        cloud.append_point(point);
        if (static_cast<int>(i % static_cast<std::size_t>(num_ranks)) != rank) continue;
        workload.coordinates.insert(workload.coordinates.end(), point.begin(), point.end());
    }
    return workload;
}

struct Ghosts {
    std::int64_t off_machine = 0;
    std::int64_t all = 0;
    std::int64_t most = 0;  ///< of a part
};

/// Cells of the unit box; those at its faces are open to the outside.
class Grid {
  public:
    Grid(const Workload& points, double radius)
        : radius_(radius), sides_(static_cast<int>(1 / radius)) {
        const std::size_t count = points.points().count;
        std::vector<std::int64_t> cells(count);
        for (std::size_t i = 0; i < count; ++i) cells[i] = cell(points.points().position(i));
        first_.resize(static_cast<std::size_t>(std::pow(sides_, points.dimension)) + 1);
        for (const std::int64_t at : cells) ++first_[at + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        points_.resize(count);
        std::vector<std::size_t> next = first_;
        for (std::size_t i = 0; i < count; ++i) points_[next[cells[i]]++] = i;
    }

    /// Calls visit(point) for the points in cells that a box reaches, grown by the radius.
    template <class Visit>
    void for_each_near(const rrcb::Box& box, int dimension, Visit&& visit) const {
        std::array<int, 3> low{};
        std::array<int, 3> high{};
        for (int axis = 0; axis < dimension; ++axis) {
            low[axis] = index(box.lower[axis] - radius_);
            high[axis] = index(box.upper[axis] + radius_);
        }
        for (int z = low[2]; z <= high[2]; ++z)
            for (int y = low[1]; y <= high[1]; ++y) {
                const auto row = (static_cast<std::size_t>(z) * sides_ + y) * sides_;
                for (std::size_t k = first_[row + low[0]]; k < first_[row + high[0] + 1]; ++k)
                    visit(points_[k]);
            }
    }

  private:
    int index(double x) const {
        return static_cast<int>(std::clamp(std::floor(x * sides_), 0.0, sides_ - 1.0));
    }
    std::int64_t cell(const rrcb::Vector& x) const {
        return (static_cast<std::int64_t>(index(x[2])) * sides_ + index(x[1])) * sides_ +
               index(x[0]);
    }

    double radius_;
    int sides_;
    std::vector<std::size_t> first_;   ///< in `points_`, of each cell
    std::vector<std::size_t> points_;  ///< by cells
};

/// Squared distance to a box.
double squared_distance(const rrcb::Box& box, const rrcb::Vector& x, int dimension) {
    double sum = 0;
    for (int axis = 0; axis < dimension; ++axis) {
        const double gap = std::max({0.0, box.lower[axis] - x[axis], x[axis] - box.upper[axis]});
        sum += gap * gap;
    }
    return sum;
}

Ghosts count_ghosts(const Case& of, const Workload& workload, const std::vector<Part>& parts) {
    const rrcb::Points points = workload.points();
    const double squared_radius = of.radius() * of.radius();
    std::vector<rrcb::Box> boxes(static_cast<std::size_t>(of.num_parts()));
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double x = points.position(i)[axis];
            boxes[parts[i]].lower[axis] = std::min(boxes[parts[i]].lower[axis], x);
            boxes[parts[i]].upper[axis] = std::max(boxes[parts[i]].upper[axis], x);
        }
    const Grid grid(workload, of.radius());
    Ghosts ghosts;
    for (Part part = 0; part < of.num_parts(); ++part) {
        const rrcb::Box& box = boxes[part];
        if (box.lower[0] > box.upper[0]) continue;
        std::int64_t needed = 0;
        grid.for_each_near(box, of.dimension, [&](std::size_t i) {
            if (parts[i] == part) return;
            if (squared_distance(box, points.position(i), of.dimension) > squared_radius) return;
            ++needed;
            ghosts.off_machine += of.machine_of(parts[i]) != of.machine_of(part) ? 1 : 0;
        });
        ghosts.all += needed;
        ghosts.most = std::max(ghosts.most, needed);
    }
    return ghosts;
}

struct Way {
    std::vector<Part> parts;  ///< of the points of this rank
    std::int64_t bytes = -1;  ///< that fetch() sends between machines; -1: not counted
};

/// Collective.
std::int64_t bytes_of_fetch(const Case& of, const rrcb::Balance& made, const Workload& workload) {
    const auto mine =
        rrcb::transfer(rrcb::plan(made, MPI_COMM_WORLD),
                       rrcb::column(workload.coordinates, of.dimension), MPI_COMM_WORLD);
    const rrcb::GhostPlan near =
        rrcb::ghosts(made.cuts, rrcb::interleaved_points(mine, of.dimension),
                     {.radius = of.radius()}, MPI_COMM_WORLD);
    comparisons::start_counting_traffic();
    static_cast<void>(rrcb::fetch(near, rrcb::column(mine, of.dimension), MPI_COMM_WORLD));
    std::int64_t bytes = comparisons::stop_counting_traffic().bytes_between_machines;
    MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return bytes;
}

Way by_rrcb(const Case& of, const Workload& workload, int num_ranks, int group_size) {
    rrcb::Options options;
    options.num_parts = of.num_parts();
    options.tree = {num_ranks == 1 || group_size == 1 ? group_size : 0};
    rrcb::Balance made = rrcb::balance(workload.points(), options, {}, MPI_COMM_WORLD);
    const std::int64_t bytes = num_ranks == 1 ? -1 : bytes_of_fetch(of, made, workload);
    return {std::move(made.parts), bytes};
}

comparisons::ZoltanParameters parameters_of(const char* method, int num_parts) {
    return {{"LB_METHOD", method},
            {"NUM_GLOBAL_PARTS", std::to_string(num_parts)},
            {"REMAP", "0"},
            {"IMBALANCE_TOL", "1.01"},
            {"RETURN_LISTS", "EXPORT"},
            {"DEBUG_LEVEL", "0"}};
}

std::vector<Part> by_zoltan(const Workload& workload, const char* method, int num_parts,
                            MPI_Comm comm,
                            const std::function<void(Zoltan_Struct*)>& prepare = {}) {
    ZoltanPartitioner zoltan(parameters_of(method, num_parts), workload, comm);
    if (prepare) prepare(zoltan.handle());
    if (zoltan.partition() != ZOLTAN_OK) throw comparisons::Failure("Zoltan failed");
    return zoltan.parts();
}

/// Levels of HIER: parts of this rank by its machine, then by its place there.
void set_levels(const Case& of, Zoltan_Struct* zoltan) {
    const auto num_levels = [](void*, int* code) {
        *code = ZOLTAN_OK;
        return 2;
    };
    const auto part = [](void* data, int level, int* code) {
        *code = ZOLTAN_OK;
        const Case& given = *static_cast<const Case*>(data);
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        return level == 0 ? given.machine_of(rank) : rank % given.ranks_each;
    };
    const auto method = [](void*, int, Zoltan_Struct* at_level, int* code) {
        *code = Zoltan_Set_Param(at_level, "LB_METHOD", "RCB");
        Zoltan_Set_Param(at_level, "IMBALANCE_TOL", "1.005");
    };
    void* data = const_cast<Case*>(&of);
    Zoltan_Set_Hier_Num_Levels_Fn(zoltan, num_levels, data);
    Zoltan_Set_Hier_Part_Fn(zoltan, part, data);
    Zoltan_Set_Hier_Method_Fn(zoltan, method, data);
}

/// HIER as one process makes it: RCB into machines, then RCB of each.
std::vector<Part> by_levels(const Case& of, const Workload& workload) {
    std::vector<Part> parts = by_zoltan(workload, "RCB", of.machines, MPI_COMM_SELF);
    std::vector<std::vector<std::size_t>> of_machines(static_cast<std::size_t>(of.machines));
    for (std::size_t i = 0; i < parts.size(); ++i) of_machines[parts[i]].push_back(i);
    const auto axes = static_cast<std::size_t>(of.dimension);
    for (int machine = 0; machine < of.machines; ++machine) {
        Workload here{"", "", of.dimension, {}, false, {}};
        for (const std::size_t i : of_machines[machine])
            here.coordinates.insert(here.coordinates.end(), &workload.coordinates[i * axes],
                                    &workload.coordinates[i * axes] + axes);
        const std::vector<Part> inside = by_zoltan(here, "RCB", of.ranks_each, MPI_COMM_SELF);
        for (std::size_t k = 0; k < inside.size(); ++k)
            parts[of_machines[machine][k]] = machine * of.ranks_each + inside[k];
    }
    return parts;
}

/// The entries of all ranks, on rank 0. Collective.
template <class Number>
std::vector<Number> gathered(const std::vector<Number>& here, MPI_Datatype type) {
    const int count = static_cast<int>(here.size());
    std::vector<int> counts(static_cast<std::size_t>(comparisons::size_of(MPI_COMM_WORLD)));
    std::vector<int> offsets(counts.size() + 1);
    MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::partial_sum(counts.begin(), counts.end(), offsets.begin() + 1);
    std::vector<Number> all(static_cast<std::size_t>(offsets.back()));
    MPI_Gatherv(here.data(), count, type, all.data(), counts.data(), offsets.data(), type, 0,
                MPI_COMM_WORLD);
    return all;
}

/// Counts on rank 0. Collective.
void print(const Case& of, const Workload& workload, const char* name, Way way) {
    const Workload all{"", "", of.dimension, gathered(workload.coordinates, MPI_DOUBLE), false, {}};
    const std::vector<Part> parts = gathered(way.parts, MPI_INT32_T);
    if (parts.empty()) return;
    std::vector<std::int64_t> sizes(static_cast<std::size_t>(of.num_parts()));
    for (const Part part : parts) ++sizes[part];
    const Ghosts ghosts = count_ghosts(of, all, parts);
    std::printf("%d,%d,%d,%s,%u,%s,%.5f,%lld,%lld,%lld,%lld\n", of.machines, of.ranks_each,
                of.dimension, of.cloud.c_str(), of.seed, name,
                static_cast<double>(std::ranges::max(sizes)) * of.num_parts() /
                    static_cast<double>(of.num_points),
                static_cast<long long>(ghosts.off_machine), static_cast<long long>(ghosts.all),
                static_cast<long long>(ghosts.most), static_cast<long long>(way.bytes));
    std::fflush(stdout);
}

/// Collective.
void run(const Case& of) {
    const int rank = comparisons::rank_of(MPI_COMM_WORLD);
    const int num_ranks = comparisons::size_of(MPI_COMM_WORLD);
    if (num_ranks != 1 && num_ranks != of.num_parts())
        throw comparisons::Failure("start one process, or one for each rank of the machines");
    comparisons::set_ranks_per_machine(of.ranks_each);
    const Workload workload = points_here(of, rank, num_ranks);
    if (rank == 0)
        std::puts(
            "machines,ranks,dimension,cloud,seed,method,imbalance,off_machine,ghosts,most,bytes");
    print(of, workload, "halving", by_rrcb(of, workload, num_ranks, 1));
    print(of, workload, "machines", by_rrcb(of, workload, num_ranks, of.ranks_each));
    print(of, workload, "zoltan-rcb", {by_zoltan(workload, "RCB", of.num_parts(), MPI_COMM_WORLD)});
    const auto levels = [&](Zoltan_Struct* zoltan) { set_levels(of, zoltan); };
    print(of, workload, "zoltan-hier",
          {num_ranks == 1 ? by_levels(of, workload)
                          : by_zoltan(workload, "HIER", of.num_parts(), MPI_COMM_WORLD, levels)});
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    float version = 0;
    Zoltan_Initialize(argc, argv, &version);
    int code = 0;
    try {
        if (argc != 7) throw comparisons::Failure("six arguments are needed; see the source");
        Case of{std::stoi(argv[1]), std::stoi(argv[2]), std::stoi(argv[3]), argv[4],
                static_cast<unsigned>(std::stoul(argv[5]))};
        of.num_points = std::stoul(argv[6]) * static_cast<std::size_t>(of.num_parts());
        run(of);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rrcb_machines: %s\n", error.what());
        code = 1;
    }
    if (code != 0) MPI_Abort(MPI_COMM_WORLD, code);
    MPI_Finalize();
}
