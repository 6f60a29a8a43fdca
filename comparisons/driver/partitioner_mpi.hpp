#pragma once

#include "method.hpp"
#include "partitioner.hpp"
#include "workload_mpi.hpp"

#include <rrcb/points.hpp>

#include <balancers_mpi.hpp>
#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <zoltan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace comparisons {

/// The data of the callbacks: the points of this rank, numbered across all ranks.
struct NumberedPoints {
    rrcb::Points points;
    ZOLTAN_ID_TYPE first_id = 0;
};

/// Calls Zoltan_LB_Partition. All methods of Zoltan use the same callbacks and lists.
///
/// Makes one part per rank. The arrays of the points must outlive the object.
class ZoltanPartitioner : public Partitioner {
  public:
    /// Collective over `comm`. Throws Failure if Zoltan rejects a parameter.
    ZoltanPartitioner(const ZoltanParameters& parameters, const Workload& workload, MPI_Comm comm);
    ~ZoltanPartitioner() override;

    int partition() override;
    std::vector<int> parts() const override;
    std::string function() const override { return "Zoltan_LB_Partition"; }
    void free_lists() override;                  ///< calls Zoltan_LB_Free_Part
    void use_seed(std::uint64_t seed) override;  ///< sets RRCB_SEED
    /// Replaces the points of the following partitions. Collective.
    void use_points(const rrcb::Points& points);

    Zoltan_Struct* handle() const { return zoltan_; }  ///< for further settings

    /// Returns the box of a part, computed from the kept cuts. Open sides are +-infinity. Throws
    /// Failure unless KEEP_CUTS is set. Not collective.
    rrcb::Box box_of(rrcb::Part part) const;

  private:
    struct ObjectLists {
        int count = -1;
        ZOLTAN_ID_PTR global_ids = nullptr;
        ZOLTAN_ID_PTR local_ids = nullptr;
        int* ranks = nullptr;
        int* parts = nullptr;
    };

    MPI_Comm comm_;
    NumberedPoints points_;
    Zoltan_Struct* zoltan_ = nullptr;
    ObjectLists imports_;
    ObjectLists exports_;
};

/// Returns the partitioner of a method. Collective over `comm`; the workload must outlive it.
///
/// Throws Failure if a parameter is rejected.
std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm);

/// Returns a balancer for simulations, or nullopt if the parts of the method are no boxes (RIB,
/// HSFC). Only rrcb-arrays accepts `weights`.
///
/// Except for rrcb-arrays it uses Zoltan's callbacks, lists and look-ups. The look-ups require
/// KEEP_CUTS=1. Part p is sent to rank p, so REMAP is 0.
std::optional<mpm::Balancer> make_balancer(const Method& method, const PointWeights& weights = {});

}  // namespace comparisons
