#pragma once

#include <rrcb/points.hpp>

#include <cstdint>
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

    /// Frees the result; nothing when there is none. Not collective.
    virtual void free_lists() = 0;

    /// Seed of the next partitions' pseudo-random points; nothing to methods without any.
    /// Not collective, but the same on every rank.
    virtual void use_seed(std::uint64_t) {}
};

}  // namespace comparisons
