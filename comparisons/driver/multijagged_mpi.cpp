#include "multijagged_mpi.hpp"

#include <Kokkos_Core.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <zoltan.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <limits>
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

Teuchos::ParameterList parameters_of(double tolerance, bool keeps_boxes) {
    Teuchos::ParameterList parameters;
    parameters.set("algorithm", "multijagged");
    parameters.set("imbalance_tolerance", tolerance);
    parameters.set("mj_keep_part_boxes", keeps_boxes);
    return parameters;
}

class MultijaggedPartitioner : public Partitioner {
  public:
    MultijaggedPartitioner(const MultijaggedPoints& points, double tolerance, MPI_Comm comm,
                           bool keeps_boxes = false)
        : ids_(numbered(points.count, comm)),
          adapter_(make_adapter(points, ids_)),
          parameters_(parameters_of(tolerance, keeps_boxes)),
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

    MultijaggedBoxes boxes(std::size_t dimension) const {
        const auto& boxes = problem_.getSolution().getPartBoxesView();
        MultijaggedBoxes result{parts(), {}, {}};
        result.lower.resize(boxes.size());
        result.upper.resize(boxes.size());
        for (const auto& box : boxes) {
            const auto part = static_cast<std::size_t>(box.getpId());
            std::copy_n(box.getlmins(), dimension, result.lower[part].begin());
            std::copy_n(box.getlmaxs(), dimension, result.upper[part].begin());
        }
        return result;
    }

  private:
    std::vector<long long> ids_;
    Adapter adapter_;
    Teuchos::ParameterList parameters_;
    mutable Zoltan2::PartitioningProblem<Adapter> problem_;  // its getSolution() is not const
};

/// Opens the faces that are on the box of all points.
void open_outwards(MultijaggedBoxes& boxes, std::size_t dimension) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        double least = infinity;
        double most = -infinity;
        for (const auto& lower : boxes.lower) least = std::min(least, lower[axis]);
        for (const auto& upper : boxes.upper) most = std::max(most, upper[axis]);
        for (auto& lower : boxes.lower)
            if (lower[axis] == least) lower[axis] = -infinity;
        for (auto& upper : boxes.upper)
            if (upper[axis] == most) upper[axis] = infinity;
    }
}

}  // namespace

std::unique_ptr<Partitioner> make_multijagged(const MultijaggedPoints& points, double tolerance,
                                              MPI_Comm comm) {
    start_kokkos();
    return std::make_unique<MultijaggedPartitioner>(points, tolerance, comm);
}

MultijaggedBoxes divide_multijagged(const MultijaggedPoints& points, double tolerance,
                                    MPI_Comm comm) {
    start_kokkos();
    MultijaggedPartitioner partitioner(points, tolerance, comm, true);
    if (partitioner.partition() != ZOLTAN_OK) throw std::runtime_error("multijagged failed");
    MultijaggedBoxes boxes = partitioner.boxes(points.axes.size());
    open_outwards(boxes, points.axes.size());
    return boxes;
}

}  // namespace comparisons
