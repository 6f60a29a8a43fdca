#pragma once

#include <rrcb/controller.hpp>
#include <rrcb/cost.hpp>

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Saves and loads what has private members; as save() and load(). Collective.
struct Restart {
    static std::vector<std::byte> save(const Controller& controller);
    static std::vector<std::byte> save(const CostModel& model);
    static Controller load_controller(std::span<const std::byte> bytes, MPI_Comm comm);
    static CostModel load_model(std::span<const std::byte> bytes, MPI_Comm comm);
    static CostModel load_model(std::span<const std::byte> bytes, Controller& controller);
};

}  // namespace rrcb
