#pragma once

#include "effects/effect.hpp"
#include "materials/material.hpp"
#include "parallel/communicator_mpi.hpp"
#include "parallel/ghost_nodes_mpi.hpp"
#include "parallel/strays.hpp"
#include "scene/lattice.hpp"
#include "scene/light_nodes.hpp"
#include "step/work.hpp"
#include "transfer/transfers.hpp"

#include <rrcb/controller.hpp>
#include <rrcb/experimental/cost.hpp>
#include <rrcb/neighbours.hpp>

#include <mpm/simulation.hpp>

#include <limits>
#include <optional>
#include <span>

namespace mpm {

/// Returns a communicator of the same ranks. Collective.
inline MPI_Comm duplicate(MPI_Comm comm) {
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_dup(comm, &own);
    return own;
}

/// Interface of the implementations for two and three dimensions. It has virtual calls once per
/// step, not once per point.
class Simulation::Model {
  public:
    Model(const Scene& scene, MPI_Comm comm)
        : start_places(scene), comm_(duplicate(comm)), controller(comm_) {}
    virtual ~Model() { MPI_Comm_free(&comm_); }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
    /// Divides the points by a balancer, or makes a step if there is none. Returns the number of
    /// points that have gone to other ranks.
    virtual std::size_t turn(const Balancer* balancer) = 0;
    virtual std::vector<std::string> kernels() const = 0;
    virtual std::size_t doubles_per_ghost_node() const = 0;
    virtual std::vector<double> work_columns() const = 0;
    virtual std::vector<double> point_columns() const = 0;
    virtual Totals totals() const = 0;
    virtual std::vector<std::pair<std::string, double>> reports() const = 0;
    virtual Positions positions() const = 0;
    virtual void write_state(const std::string& path) const = 0;
    virtual void read_state(const std::string& path) = 0;

    Particles particles;
    StartPlaces start_places;
    Decomposition decomposition;
    std::int64_t num_points = 0, num_steps = 0;
    std::int64_t num_sent = 0;  ///< points sent by this rank
    double time = 0, time_step = 0, max_speed = 0;
    WorkClock work;            ///< time of the last step
    double worked_points = 0;  ///< points of this rank in the last step

  protected:
    MPI_Comm comm_;

  public:
    rrcb::Controller controller;
    std::optional<rrcb::experimental::CostModel> costs;
};

/// Advances a scene of D dimensions. The function turn() lists the stages.
template <int D>
class Stepper final : public Simulation::Model {
  public:
    Stepper(const Scene& scene, const ScenePoints& points, MPI_Comm comm);

    std::size_t turn(const Balancer* balancer) override;
    std::vector<std::string> kernels() const override;
    std::size_t doubles_per_ghost_node() const override {
        return 1 + 2 * D + stages_.fields.size();
    }
    std::vector<double> work_columns() const override;
    std::vector<double> point_columns() const override;
    Totals totals() const override;
    std::vector<std::pair<std::string, double>> reports() const override;
    void write_state(const std::string& path) const override;
    void read_state(const std::string& path) override;
    Positions positions() const override { return positions_of(particles, motion_, D); }

  private:
    void build_materials();
    std::string state_names() const;
    std::vector<double> state_scene() const;
    std::vector<double> state_numbers(double speed) const;
    std::vector<double> state_section() const;
    void load_state(const std::string& path);
    void append_own(std::span<const double> rows);
    std::vector<int> owners_by(const Decomposition& next) const;
    void divide_by(Decomposition next);
    void fit_to_box(std::size_t num_new);
    void fit_to_points(std::size_t num_new);
    void end_step(double speed_before);
    void points_to_nodes();
    void move_nodes();
    void nodes_to_points();
    void apply_materials(const PointBlock<D>& block);
    double fastest_point() const;
    double fastest();
    double speed_of_all(double mine) const;
    void set_time_step();
    void fit_patch();
    void sort();
    void sort_if_needed(std::size_t num_arrived);

    Scene scene_;
    Scene ground_;  ///< the scene, with planes in place of walls with friction
    MotionColumns motion_ = add_motion_columns(particles, D);
    StepRule rule_;
    std::unique_ptr<Transfers<D>> transfers_;
    std::vector<MaterialModel<D>> materials_;
    std::optional<Column> material_column_;  ///< present if the scene has several materials
    Stages<D> stages_;
    /// lightest point of all ranks, kg
    double lightest_point_ = std::numeric_limits<double>::infinity();
    double fastest_node_ = 0;  ///< speed of this rank's fastest node in the last step, m/s; see
                               ///< move_nodes
    double fingerprint_;       ///< identifies the points at the start

    Strays strays_;
    bool has_outgrown_ = false;  ///< some point is outside home_
    std::optional<rrcb::Neighbours> neighbours_;
    rrcb::NeighbourOptions travel_;  ///< over which ranks share nodes
    double speed_ = 0;               ///< of this rank in the last step, m/s
    double start_speed_ = 0;         ///< of all ranks before the first step or after a restart, m/s
    GridPatch<D> patch_;
    Box home_;  ///< the part of this rank's box that the patch covers
    std::optional<GhostNodes<D>> ghosts_;
    std::vector<CellRun<D>> runs_;
    std::unique_ptr<VelocityGradients<D>> gradients_ = std::make_unique<VelocityGradients<D>>();
    std::size_t num_sorted_runs_ = 0;  ///< runs in the first step after a sort; 0 before it
};

}  // namespace mpm
