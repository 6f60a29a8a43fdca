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

/// What the callbacks see: the points of this rank, numbered through over all ranks.
struct NumberedPoints {
    rrcb::Points points;
    ZOLTAN_ID_TYPE first_id = 0;
};

/// Zoltan_LB_Partition on points; every method goes through the same callbacks and lists.
///
/// Makes one part per rank. The arrays of the points must live as long as it.
class ZoltanPartitioner : public Partitioner {
  public:
    /// Collective over `comm`. Throws Failure when Zoltan refuses a parameter.
    ZoltanPartitioner(const ZoltanParameters& parameters, const Workload& workload, MPI_Comm comm);
    ~ZoltanPartitioner() override;

    int partition() override;
    std::vector<int> parts() const override;
    std::string function() const override { return "Zoltan_LB_Partition"; }
    void free_lists() override;                  ///< Zoltan_LB_Free_Part
    void use_seed(std::uint64_t seed) override;  ///< RRCB_SEED
    /// Takes other points for the next partitions. Collective.
    void use_points(const rrcb::Points& points);

    Zoltan_Struct* handle() const { return zoltan_; }  ///< for settings of other kinds

    /// Box of a part by the kept cuts; open sides are +-infinity. Throws Failure without KEEP_CUTS.
    /// Not collective.
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

/// The partitioner that a method names. Collective over `comm`; the workload must outlive it.
///
/// Throws Failure when a parameter is refused.
std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm);

/// A method as the simulation takes it; none when its parts are no boxes (RIB, HSFC). Only
/// rrcb-arrays takes `weights`.
///
/// Through Zoltan's callbacks, lists and look-ups, but for rrcb-arrays; with KEEP_CUTS=1 for the
/// look-ups and REMAP=0, as part p goes to rank p.
std::optional<mpm::Balancer> make_balancer(const Method& method, const PointWeights& weights = {});

}  // namespace comparisons
