#include "balancer_mpi.hpp"

#include "failure_mpi.hpp"
#include "rrcb_balancer_mpi.hpp"
#include "zoltan_partitioner_mpi.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace comparisons {

namespace {

mpm::Box box_along(const rrcb::Box& box, int dimension) {
    mpm::Box result{};
    std::copy_n(box.lower.begin(), dimension, result.lower.begin());
    std::copy_n(box.upper.begin(), dimension, result.upper.begin());
    return result;
}

rrcb::Points points_of(mpm::Positions positions) {
    const std::array<std::span<const double>, 3> columns{positions.x, positions.y, positions.z};
    return rrcb::column_points(std::span(columns).first(positions.z.empty() ? 2 : 3));
}

/// Zoltan's handle, kept from one balance to the next because the look-ups of the simulation need
/// its cuts; its callbacks read the simulation's own columns.
class ZoltanBalancer {
  public:
    explicit ZoltanBalancer(ZoltanParameters parameters) : parameters_(std::move(parameters)) {
        parameters_.emplace_back("KEEP_CUTS", "1");
        parameters_.emplace_back("REMAP", "0");
    }

    mpm::Decomposition decompose(mpm::Positions positions, MPI_Comm comm) {
        const rrcb::Points points = points_of(positions);
        if (partitioner_) {
            partitioner_->use_points(points);
        } else {
            partitioner_.emplace(parameters_, points, comm);
        }
        const int code = partitioner_->partition();
        fail_together(code < 0 ? "Zoltan_LB_Partition returned " + std::to_string(code) : "", comm);
        mpm::Decomposition decomposition;
        decomposition.boxes = boxes(points.dimension, comm);
        decomposition.local_owners = partitioner_->parts();
        partitioner_->free_lists();
        return decomposition;
    }

    void find_owners(mpm::Positions at, std::span<int> owners) const {
        for (std::size_t i = 0; i < owners.size(); ++i) {
            owners[i] = partitioner_->part_of(at[i]);
        }
    }

  private:
    std::vector<mpm::Box> boxes(int dimension, MPI_Comm comm) const {
        int num_parts = 0;
        MPI_Comm_size(comm, &num_parts);
        std::vector<mpm::Box> boxes;
        for (int part = 0; part < num_parts; ++part) {
            boxes.push_back(box_along(partitioner_->box_of(part), dimension));
        }
        return boxes;
    }

    ZoltanParameters parameters_;
    std::optional<ZoltanPartitioner> partitioner_;
};

}  // namespace

std::vector<double> interleaved(mpm::Positions positions) {
    const std::size_t dimension = positions.z.empty() ? 2 : 3;
    std::vector<double> coordinates;
    coordinates.reserve(dimension * positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const mpm::Vector at = positions[i];
        coordinates.insert(coordinates.end(), at.begin(), at.begin() + dimension);
    }
    return coordinates;
}

std::optional<mpm::Balancer> make_balancer(const Method& method) {
    if (method.lb_method == on_arrays) return rrcb_balancer(*method.options);
    if (method.lb_method != "RCB" && method.lb_method != "RRCB") return std::nullopt;
    auto zoltan = std::make_shared<ZoltanBalancer>(zoltan_parameters(method, Lists::parts));
    return [zoltan](mpm::Positions positions, MPI_Comm comm) {
        mpm::Decomposition decomposition = zoltan->decompose(positions, comm);
        decomposition.owners = [zoltan](mpm::Positions at, std::span<int> owners) {
            zoltan->find_owners(at, owners);
        };
        return decomposition;
    };
}

}  // namespace comparisons
