// zoltan2_client METHOD: Zoltan2's own algorithm=zoltan with that LB_METHOD; no word of RRCB.
#include <Tpetra_Core.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using Types = Zoltan2::BasicUserTypes<double, int, long long>;
using Adapter = Zoltan2::BasicVectorAdapter<Types>;
constexpr int num_points = 1000;

struct Cloud {
    std::vector<long long> ids;
    std::vector<double> x, y;
};

Cloud cloud_of(int rank) {
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

double imbalance_of(const int* parts, int num_parts) {
    std::vector<int> counts(static_cast<std::size_t>(num_parts), 0);
    for (int i = 0; i < num_points; ++i) ++counts[static_cast<std::size_t>(parts[i])];
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), num_parts, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return *std::max_element(counts.begin(), counts.end()) / static_cast<double>(num_points);
}

}  // namespace

int main(int argc, char** argv) {
    const Tpetra::ScopeGuard guard(&argc, &argv);
    int rank = 0, num_ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    const char* method = argc > 1 ? argv[1] : "RCB";
    const Cloud cloud = cloud_of(rank);
    Adapter adapter(num_points, cloud.ids.data(), cloud.x.data(), cloud.y.data(), nullptr);
    Teuchos::ParameterList parameters = parameters_with(method);
    Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &parameters);
    try {
        problem.solve();
    } catch (const std::exception& thrown) {
        if (rank == 0) std::fprintf(stderr, "%s\n", thrown.what());
        return 1;
    }
    const double imbalance = imbalance_of(problem.getSolution().getPartListView(), num_ranks);
    if (rank == 0) std::printf("%s: imbalance %.4f\n", method, imbalance);
    return imbalance < 1.02 ? 0 : 1;
}
