#include "balancer_mpi.hpp"

#include "failure_mpi.hpp"
#include "rrcb_balancer_mpi.hpp"
#include "zoltan_partitioner_mpi.hpp"

#include <memory>

namespace comparisons {

namespace {

mpm::Box plane_box(const rrcb::Box& box) {
    return {{box.lower[0], box.lower[1]}, {box.upper[0], box.upper[1]}};
}

/// Zoltan's handle and the points its callbacks see, kept from one balance to the next because
/// the look-ups of the simulation need the handle's cuts.
class ZoltanBalancer {
  public:
    explicit ZoltanBalancer(ZoltanParameters parameters) : parameters_(std::move(parameters)) {
        parameters_.emplace_back("KEEP_CUTS", "1");
        parameters_.emplace_back("REMAP", "0");
    }

    mpm::Decomposition decompose(mpm::Positions positions, MPI_Comm comm) {
        store(positions);
        if (!partitioner_) partitioner_.emplace(parameters_, points_, comm);
        partitioner_->number_points();
        const int code = partitioner_->partition();
        fail_together(code < 0 ? "Zoltan_LB_Partition returned " + std::to_string(code) : "", comm);
        mpm::Decomposition decomposition;
        decomposition.boxes = boxes(comm);
        decomposition.local_owners = partitioner_->parts();
        partitioner_->free_lists();
        return decomposition;
    }

    void find_owners(mpm::Positions at, std::span<int> owners) const {
        for (std::size_t i = 0; i < owners.size(); ++i) {
            owners[i] = partitioner_->part_of({at.x[i], at.y[i], 0});
        }
    }

  private:
    void store(mpm::Positions positions) {
        points_.coordinates.resize(2 * positions.x.size());
        for (std::size_t i = 0; i < positions.x.size(); ++i) {
            points_.coordinates[2 * i] = positions.x[i];
            points_.coordinates[2 * i + 1] = positions.y[i];
        }
    }

    std::vector<mpm::Box> boxes(MPI_Comm comm) const {
        int num_parts = 0;
        MPI_Comm_size(comm, &num_parts);
        std::vector<mpm::Box> boxes;
        for (int part = 0; part < num_parts; ++part) {
            boxes.push_back(plane_box(partitioner_->box_of(part)));
        }
        return boxes;
    }

    ZoltanParameters parameters_;
    Workload points_;
    std::optional<ZoltanPartitioner> partitioner_;
};

}  // namespace

std::optional<mpm::Balancer> make_balancer(const Method& method) {
    if (method.options) return rrcb_balancer(*method.options);
    if (method.lb_method != "RCB") return std::nullopt;
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
