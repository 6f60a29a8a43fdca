// zoltan2_client [method [points]]: Zoltan2's own algorithm=zoltan with that LB_METHOD; no word of
// RRCB.
#include "result.hpp"

#include <Tpetra_Core.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

namespace {

using Types = Zoltan2::BasicUserTypes<double, int, long long>;
using Adapter = Zoltan2::BasicVectorAdapter<Types>;

struct Cloud {
    std::vector<long long> ids;
    std::vector<double> x, y;
};

Cloud cloud_of(int rank, int num_points) {
    std::mt19937 random(static_cast<unsigned>(rank + 1));
    std::uniform_real_distribution<double> uniform(0, 1);
    Cloud cloud;
    for (int i = 0; i < num_points; ++i) {
        cloud.ids.push_back(num_points * rank + i);
        cloud.x.push_back(uniform(random));
        cloud.y.push_back(uniform(random) * uniform(random));
    }
    return cloud;
}

Teuchos::ParameterList parameters_with(const char* method) {
    Teuchos::ParameterList parameters;
    parameters.set("algorithm", "zoltan");
    Teuchos::ParameterList& zoltan = parameters.sublist("zoltan_parameters");
    zoltan.set("LB_METHOD", method);
    zoltan.set("DEBUG_LEVEL", "0");
    return parameters;
}

/// How many objects each part has. Collective.
std::vector<int> counts_of(const int* parts, int num_points, int num_parts) {
    std::vector<int> counts(static_cast<std::size_t>(num_parts), 0);
    for (int i = 0; i < num_points; ++i) ++counts.at(static_cast<std::size_t>(parts[i]));
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), num_parts, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return counts;
}

}  // namespace

int main(int argc, char** argv) {
    const Tpetra::ScopeGuard guard(&argc, &argv);
    int rank = 0, num_ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    const char* method = argc > 1 ? argv[1] : "RCB";
    const int num_points = argc > 2 ? std::atoi(argv[2]) : 1000;
    const Cloud cloud = cloud_of(rank, num_points);
    Adapter adapter(num_points, cloud.ids.data(), cloud.x.data(), cloud.y.data(), nullptr);
    Teuchos::ParameterList parameters = parameters_with(method);
    Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &parameters);
    try {
        problem.solve();
    } catch (const std::exception& thrown) {
        if (rank == 0) std::fprintf(stderr, "%s\n", thrown.what());
        return 1;
    }
    const std::vector<int> counts =
        counts_of(problem.getSolution().getPartListView(), num_points, num_ranks);
    const double imbalance =
        *std::max_element(counts.begin(), counts.end()) / static_cast<double>(num_points);
    print_result(std::accumulate(counts.begin(), counts.end(), 0), imbalance, {});
    return imbalance < 1.02 ? 0 : 1;
}
