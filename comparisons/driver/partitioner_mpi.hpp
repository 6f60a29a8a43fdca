#pragma once

#include "method.hpp"
#include "workload_mpi.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <zoltan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace comparisons {

/// What is measured: one partition after the other of the same points, one part per rank.
class Partitioner {
  public:
    Partitioner() = default;
    virtual ~Partitioner() = default;
    Partitioner(const Partitioner&) = delete;
    Partitioner& operator=(const Partitioner&) = delete;

    /// Partitions; the result of an earlier call must have been freed. Collective; returns
    /// Zoltan's code on this rank.
    virtual int partition() = 0;

    /// Part of every local point, as the result tells. Not collective.
    virtual std::vector<rrcb::Part> parts() const = 0;

    /// What it calls, for what is told of a failure. Not collective.
    virtual std::string function() const = 0;

    /// Frees the result; nothing when there is none. Not collective.
    virtual void free_lists() = 0;

    /// Seed of the next partitions' pseudo-random points; nothing to methods without any.
    /// Not collective, but the same on every rank.
    virtual void use_seed(std::uint64_t) {}
};

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
    std::vector<rrcb::Part> parts() const override;
    std::string function() const override { return "Zoltan_LB_Partition"; }
    void free_lists() override;                  ///< Zoltan_LB_Free_Part
    void use_seed(std::uint64_t seed) override;  ///< RRCB_SEED

    /// Box of a part by the kept cuts; open sides are +-infinity. Throws Failure without KEEP_CUTS.
    /// Not collective.
    rrcb::Box box_of(rrcb::Part part) const;

  private:
    void number_points();

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

/// Coordinates of a simulation's points as a workload has them.
std::vector<double> interleaved(mpm::Positions positions);

/// A method as the simulation takes it; none when its parts are no boxes (RIB, HSFC).
///
/// Through Zoltan's callbacks, lists and look-ups, but for rrcb-arrays; with KEEP_CUTS=1 for the
/// look-ups and REMAP=0, as part p goes to rank p.
std::optional<mpm::Balancer> make_balancer(const Method& method);

}  // namespace comparisons
