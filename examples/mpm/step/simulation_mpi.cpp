#include "step/stepper.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Removes materials that no body uses: each would take a column of the points.
Scene without_unused_materials(Scene scene) {
    std::erase_if(scene.materials, [&](const Material& material) {
        return std::ranges::none_of(
            scene.bodies, [&](const Body& body) { return body.material == material.name; });
    });
    return scene;
}

}  // namespace

Simulation::Simulation(const Scene& whole, MPI_Comm comm) {
    validate(whole);
    const Scene scene = without_unused_materials(whole);
    const ScenePoints points = scene_points(scene);
    if (scene.dimension == 2)
        model_ = std::make_unique<Stepper<2>>(scene, points, comm);
    else
        model_ = std::make_unique<Stepper<3>>(scene, points, comm);
}

Simulation::Simulation(const Scene& scene, const std::string& state, MPI_Comm comm)
    : Simulation(scene, comm) {
    model_->read_state(state);
}

Simulation::~Simulation() = default;

void Simulation::write_state(const std::string& path) const {
    model_->write_state(path);
}

void Simulation::step() {
    model_->num_sent += static_cast<std::int64_t>(model_->turn(nullptr));
}
std::size_t Simulation::rebalance(const Balancer& balancer) {
    const std::size_t num_sent = model_->turn(&balancer);
    model_->num_sent += static_cast<std::int64_t>(num_sent);
    return num_sent;
}
bool Simulation::due() const {
    return model_->controller.due();
}
rrcb::experimental::CostModel& Simulation::learn_costs() {
    constexpr int num_columns = 4;
    if (!model_->costs) model_->costs.emplace(model_->controller, num_columns);
    return *model_->costs;
}
double Simulation::time() const {
    return model_->time;
}
double Simulation::time_step() const {
    return model_->time_step;
}
std::int64_t Simulation::step_count() const {
    return model_->num_steps;
}
std::int64_t Simulation::num_points() const {
    return model_->num_points;
}
double Simulation::max_speed() const {
    return model_->max_speed;
}
double Simulation::work_seconds() const {
    return model_->work.seconds();
}
std::vector<double> Simulation::work_columns() const {
    return model_->work_columns();
}
std::vector<double> Simulation::point_columns() const {
    return model_->point_columns();
}
const Particles& Simulation::particles() const {
    return model_->particles;
}
Positions Simulation::positions() const {
    return model_->positions();
}
std::vector<Vector> Simulation::displacements() const {
    return model_->start_places.displacements(positions(), particles()["id"]);
}
double Simulation::front_x(double way) const {
    return model_->start_places.front_x(positions(), particles()["id"], way);
}
const Decomposition& Simulation::decomposition() const {
    return model_->decomposition;
}
std::vector<std::string> Simulation::kernels() const {
    return model_->kernels();
}
std::size_t Simulation::doubles_per_ghost_node() const {
    return model_->doubles_per_ghost_node();
}
std::vector<std::pair<std::string, double>> Simulation::reports() const {
    return model_->reports();
}
Totals Simulation::totals() const {
    return model_->totals();
}

}  // namespace mpm
