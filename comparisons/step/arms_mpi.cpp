#include "arms_mpi.hpp"

#include "failure.hpp"

#include <rrcb/rrcb.hpp>

#include <memory>
#include <tuple>

namespace comparisons {

Arm make_arm(std::string_view name, const Flow& flow) {
    if (name == "loop") return loop(flow);
    if (name == "neighbours") return neighbours(flow);
    if (name == "by-hand") return by_hand(flow);
    throw Failure("there is no arm " + std::string(name));
}

Arm loop(const Flow& flow) {
    struct State {
        rrcb::Balance balance{};
        rrcb::Plan plan{};
        rrcb::GhostPlan near{};
    };
    const auto state = std::make_shared<State>();
    state->balance.cuts = flow.cuts();
    const MPI_Comm comm = flow.comm();
    const double radius = flow.radius();
    return {
        {"assign_all",
         [=](const Particles& p) {
             state->balance.parts = rrcb::assign(state->balance.cuts, p.points(), comm);
         }},
        {"plan", [=](const Particles&) { state->plan = rrcb::plan(state->balance, comm); }},
        {"transfer",
         [=](Particles& p) {
             std::tie(p.x, p.v, p.ids) = rrcb::transfer(
                 state->plan, rrcb::columns(p.column(p.x), p.column(p.v), p.ids), comm);
         }},
        {"ghosts",
         [=](const Particles& p) {
             state->near =
                 rrcb::ghost_plan(state->balance.cuts, p.points(), comm, {.cutoff = radius});
         }},
        {"fetch",
         [=](Particles& p) {
             std::tie(p.ghost_x, p.ghost_v, p.ghost_ids) =
                 rrcb::fetch(state->near, rrcb::columns(p.column(p.x), p.column(p.v), p.ids), comm);
         }},
        {"accumulate",
         [=](Particles& p) {
             p.forces =
                 rrcb::accumulate(state->near, p.column(p.ghost_forces), p.column(p.forces), comm);
         }},
    };
}

Arm neighbours(const Flow& flow) {
    using rrcb::column;
    const auto near = std::make_shared<rrcb::Neighbours>(
        flow.cuts(), flow.comm(),
        rrcb::NeighbourOptions{.cutoff = flow.radius(), .travel = flow.travel()});
    const std::size_t width = static_cast<std::size_t>(flow.dimension());
    return {
        {"migrate",
         [=](Particles& p) { near->migrate(column(p.x, width), column(p.v, width), p.ids); }},
        {"find_ghosts", [=](const Particles& p) { near->find_ghosts(column(p.x, width)); }},
        {"fetch",
         [=](Particles& p) {
             near->fetch(rrcb::ghosts_of(p.ghost_x, p.ghost_v, p.ghost_ids), column(p.x, width),
                         column(p.v, width), p.ids);
         }},
        {"accumulate",
         [=](Particles& p) {
             near->accumulate(column(p.ghost_forces, width), column(p.forces, width));
         }},
    };
}

}  // namespace comparisons
