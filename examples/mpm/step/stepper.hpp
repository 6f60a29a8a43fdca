#pragma once

#include "effects/effect.hpp"
#include "materials/material.hpp"
#include "parallel/ghost_nodes_mpi.hpp"
#include "parallel/ownership_mpi.hpp"
#include "scene/lattice.hpp"
#include "scene/light_nodes.hpp"
#include "step/work.hpp"
#include "transfer/transfers.hpp"

#include <mpm/simulation.hpp>

#include <limits>
#include <optional>
#include <span>

namespace mpm {

/// Interface of the implementations for two and three dimensions. It has virtual calls once per
/// step, not once per point.
class Simulation::Model {
  public:
    explicit Model(const Scene& scene) : start_places(scene) {}
    virtual ~Model() = default;
    virtual void step() = 0;
    virtual std::size_t rebalance(const Balancer& balancer) = 0;
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
};

/// Advances a scene of D dimensions. The function step() lists the stages.
template <int D>
class Stepper final : public Simulation::Model {
  public:
    Stepper(const Scene& scene, const ScenePoints& points, MPI_Comm comm);
    ~Stepper() override { MPI_Comm_free(&comm_); }

    void step() override;
    std::size_t rebalance(const Balancer& balancer) override;
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
    std::vector<double> state_numbers() const;
    std::vector<double> state_section() const;
    void load_state(const std::string& path);
    void append_own(std::span<const double> rows);
    void divide_by(Decomposition next);
    void advance_nodes();
    void advance_points();
    void apply_materials(const PointBlock<D>& block);
    double fastest_point() const;
    void set_time_step();
    std::size_t migrate_leavers(double speed);
    void fit_patch();
    bool fits_patch(std::size_t first) const;
    void sort();
    void sort_if_needed(std::size_t num_arrived);

    Scene scene_;
    Scene ground_;  ///< the scene, with planes in place of walls with friction
    MPI_Comm comm_;
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

    Ownership ownership_;
    GridPatch<D> patch_;
    std::vector<NodeRange<D>> ranges_;  ///< nodes of the box of each rank
    Box home_;                          ///< the part of this rank's box that the patch covers
    std::optional<GhostNodes<D>> ghosts_;
    std::vector<CellRun<D>> runs_;
    std::unique_ptr<VelocityGradients<D>> gradients_ = std::make_unique<VelocityGradients<D>>();
    std::size_t num_sorted_runs_ = 0;  ///< runs in the first step after a sort; 0 before it
};

}  // namespace mpm
