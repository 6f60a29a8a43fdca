#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// The interface of what is measured: repeated partitions of the same points, with one part per
/// rank.
class Partitioner {
  public:
    Partitioner() = default;
    virtual ~Partitioner() = default;
    Partitioner(const Partitioner&) = delete;
    Partitioner& operator=(const Partitioner&) = delete;

    /// Partitions the points. The result of the previous call must have been freed. Collective.
    /// Returns Zoltan's code on this rank.
    virtual int partition() = 0;

    /// Returns the part of every local point in the last result. Not collective.
    virtual std::vector<int> parts() const = 0;

    /// Returns the name of the function that it calls, for messages. Not collective.
    virtual std::string function() const = 0;

    /// Frees the last result if there is one. Not collective.
    virtual void free_lists() {}

    /// Sets the seed of the pseudo-random points in later partitions, if the method uses any. Not
    /// collective, but all ranks must pass the same seed.
    virtual void use_seed(std::uint64_t) {}
};

}  // namespace comparisons
