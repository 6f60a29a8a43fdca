#include "partitioner_mpi.hpp"

#include "zoltan_partitioner_mpi.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <optional>

#ifdef RRCB_HAS_ZOLTAN2
#include "multijagged_mpi.hpp"

#include <exception>
#endif

namespace comparisons {

namespace {

/// rrcb::balance as a program calls it that has its points in arrays.
class ArraysPartitioner : public Partitioner {
  public:
    ArraysPartitioner(const rrcb::Options& options, const Workload& workload, MPI_Comm comm)
        : options_(options), workload_(workload), comm_(comm) {}

    int partition() override {
        try {
            balance_ = rrcb::balance(workload_.points(), options_, comm_);
        } catch (const rrcb::Error&) {
            return ZOLTAN_FATAL;
        }
        return ZOLTAN_OK;
    }

    std::vector<rrcb::Part> parts() const override { return balance_->parts; }

    void free_lists() override { balance_.reset(); }

  private:
    rrcb::Options options_;
    const Workload& workload_;
    MPI_Comm comm_;
    std::optional<rrcb::Balance> balance_;
};

#ifdef RRCB_HAS_ZOLTAN2
class MultijaggedPartitioner : public Partitioner {
  public:
    MultijaggedPartitioner(const Workload& workload, MPI_Comm comm)
        : multijagged_({workload.points().count, workload.dimension, workload.coordinates.data(),
                        workload.weighted ? workload.weights.data() : nullptr},
                       multijagged_tolerance, comm) {}

    int partition() override {
        try {
            multijagged_.partition();
        } catch (const std::exception&) {
            return ZOLTAN_FATAL;
        }
        return ZOLTAN_OK;
    }

    std::vector<rrcb::Part> parts() const override { return multijagged_.parts(); }

    void free_lists() override {}  // Zoltan2 keeps its solution until the next one

  private:
    Multijagged multijagged_;
};
#endif

}  // namespace

std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm) {
    if (method.lb_method == on_arrays) {
        return std::make_unique<ArraysPartitioner>(*method.options, workload, comm);
    }
#ifdef RRCB_HAS_ZOLTAN2
    if (method.lb_method == multijagged) {
        return std::make_unique<MultijaggedPartitioner>(workload, comm);
    }
#endif
    return std::make_unique<ZoltanPartitioner>(zoltan_parameters(method, lists), workload, comm);
}

}  // namespace comparisons
