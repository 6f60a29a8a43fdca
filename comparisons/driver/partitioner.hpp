#pragma once

#include <cstdint>
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

    /// Part of every local point by the result. Not collective.
    virtual std::vector<int> parts() const = 0;

    /// What it calls, for messages. Not collective.
    virtual std::string function() const = 0;

    /// Frees the result if there is one. Not collective.
    virtual void free_lists() {}

    /// Seed of the next partitions' pseudo-random points, if there are any. Not collective, but the
    /// same on every rank.
    virtual void use_seed(std::uint64_t) {}
};

}  // namespace comparisons
