#include "failure_mpi.hpp"
#include "ghost_study_mpi.hpp"
#include "ghosts_mpi.hpp"
#include "row.hpp"

#include <rrcb/part_sizes.hpp>
#include <rrcb/quality.hpp>
#include <rrcb/rrcb.hpp>

#include <utility>

namespace comparisons {

namespace {

std::vector<double> loads_of(const rrcb::Balance& balance, const Ghosts& ghosts, double cost) {
    std::vector<double> loads = balance.report.part_weights;
    for (std::size_t p = 0; p < loads.size(); ++p)
        loads[p] += cost * static_cast<double>(ghosts.of_parts[p]);
    return loads;
}

std::vector<int> axes_of(const rrcb::Cuts& cuts) {
    std::vector<int> axes;
    for (const rrcb::Cut& cut : cuts.tree) axes.push_back(cut.axis);
    return axes;
}

void compare(const Cloud& cloud, MPI_Comm comm) {
    constexpr int most_corrections = 3;
    const Workload workload = cloud_workload(cloud, Layout::sorted, comm);
    const GhostCounter counter(workload, {}, comm);
    const int num_parts = size_of(comm);
    for (const double cost : {0.25, 0.5, 1.0}) {
        rrcb::Options options{.num_parts = num_parts};
        rrcb::Balance balance;
        for (int corrections = 0; corrections <= most_corrections; ++corrections) {
            const rrcb::Cuts previous = std::exchange(balance.cuts, {});
            balance = rrcb::balance(workload.points(), comm, options, previous);
            const Ghosts ghosts = counter.count(balance.parts, num_parts);
            const std::vector<double> loads = loads_of(balance, ghosts, cost);
            if (rank_of(comm) == 0)
                print(Row()
                          .add("cloud", cloud.name)
                          .add("dim", cloud.dimension)
                          .add("parts", num_parts)
                          .add("cost", cost)
                          .add("corrections", corrections)
                          .add("largest", rrcb::imbalance(loads))
                          .add("ghosts", ghosts.sum));
            options.part_sizes = rrcb::balanced_sizes(loads, options.part_sizes);
            options.expert.axes.order = rrcb::AxisOrder::given(axes_of(balance.cuts));
        }
    }
}

}  // namespace

void compare_loads(bool quick, MPI_Comm comm) {
    const auto clouds = quick ? ghost_clouds().first(1) : ghost_clouds();
    for (const char* name : clouds)
        for (const int dimension : {2, 3})
            compare({name, quick ? 1000 : ghost_points, dimension, 1}, comm);
}

}  // namespace comparisons
