#include "multijagged_mpi.hpp"

#include <Kokkos_Core.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <zoltan.h>

#include <cstdlib>
#include <exception>
#include <numeric>

namespace comparisons {

namespace {

using Adapter = Zoltan2::BasicVectorAdapter<Zoltan2::BasicUserTypes<double, int, long long>>;

void start_kokkos() {
    if (Kokkos::is_initialized()) return;
    Kokkos::initialize();
    std::atexit([] { Kokkos::finalize(); });
}

std::vector<long long> numbered(std::size_t count, MPI_Comm comm) {
    const auto mine = static_cast<long long>(count);
    long long end = mine;
    MPI_Scan(MPI_IN_PLACE, &end, 1, MPI_LONG_LONG, MPI_SUM, comm);
    std::vector<long long> ids(count);
    std::iota(ids.begin(), ids.end(), end - mine);
    return ids;
}

Adapter make_adapter(const MultijaggedPoints& points, const std::vector<long long>& ids) {
    std::vector<const double*> axes = points.axes;
    std::vector<int> strides(axes.size(), points.stride);
    std::vector<const double*> weights;
    std::vector<int> weight_strides;
    if (points.weights != nullptr) {
        weights.push_back(points.weights);
        weight_strides.push_back(1);
    }
    return Adapter(static_cast<int>(points.count), ids.data(), axes, strides, weights,
                   weight_strides);
}

Teuchos::ParameterList parameters_of(double tolerance) {
    Teuchos::ParameterList parameters;
    parameters.set("algorithm", "multijagged");
    parameters.set("imbalance_tolerance", tolerance);
    return parameters;
}

class MultijaggedPartitioner : public Partitioner {
  public:
    MultijaggedPartitioner(const MultijaggedPoints& points, double tolerance, MPI_Comm comm)
        : ids_(numbered(points.count, comm)),
          adapter_(make_adapter(points, ids_)),
          parameters_(parameters_of(tolerance)),
          problem_(&adapter_, &parameters_, comm) {}

    int partition() override {
        try {
            problem_.solve();
        } catch (const std::exception&) {
            return ZOLTAN_FATAL;
        }
        return ZOLTAN_OK;
    }

    std::vector<int> parts() const override {
        const int* parts = problem_.getSolution().getPartListView();
        return {parts, parts + ids_.size()};
    }

    std::string function() const override { return "multijagged"; }

  private:
    std::vector<long long> ids_;
    Adapter adapter_;
    Teuchos::ParameterList parameters_;
    mutable Zoltan2::PartitioningProblem<Adapter> problem_;  // its getSolution() is not const
};

}  // namespace

std::unique_ptr<Partitioner> make_multijagged(const MultijaggedPoints& points, double tolerance,
                                              MPI_Comm comm) {
    start_kokkos();
    return std::make_unique<MultijaggedPartitioner>(points, tolerance, comm);
}

}  // namespace comparisons
