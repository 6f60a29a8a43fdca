#include "partitioner_mpi.hpp"

#include "zoltan_partitioner_mpi.hpp"

#ifdef RRCB_HAS_ZOLTAN2
#include "multijagged_mpi.hpp"

#include <exception>
#endif

namespace comparisons {

#ifdef RRCB_HAS_ZOLTAN2
namespace {

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

}  // namespace
#endif

std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm) {
#ifdef RRCB_HAS_ZOLTAN2
    if (method.lb_method == multijagged) {
        return std::make_unique<MultijaggedPartitioner>(workload, comm);
    }
#endif
    return std::make_unique<ZoltanPartitioner>(zoltan_parameters(method, lists), workload, comm);
}

}  // namespace comparisons
