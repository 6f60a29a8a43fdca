#include "c/balancer.hpp"

#include <rrcb/controller.hpp>

#include <memory>

struct rrcb_controller {
    rrcb::Controller controller;
};

namespace {

template <class Controller, class Body>
int with(Controller* controller, Body&& body) noexcept {
    return rrcb::c::guarded([&] {
        rrcb::c::require(controller, "controller");
        body(controller->controller);
    });
}

void store(bool is_due, int* due) {
    if (due != nullptr) *due = is_due ? 1 : 0;
}

}  // namespace

int rrcb_controller_create(MPI_Comm comm, rrcb_controller** controller) {
    return rrcb::c::guarded([&] {
        rrcb::c::require(controller, "controller");
        *controller = std::make_unique<rrcb_controller>(rrcb::Controller(comm)).release();
    });
}

int rrcb_controller_create_fortran(MPI_Fint comm, rrcb_controller** controller) {
    return rrcb_controller_create(MPI_Comm_f2c(comm), controller);
}

void rrcb_controller_destroy(rrcb_controller* controller) {
    delete controller;
}

int rrcb_controller_step(rrcb_controller* controller, double load, int* due) {
    return with(controller, [&](rrcb::Controller& own) { store(own.step(load), due); });
}

int rrcb_controller_step_points(rrcb_controller* controller, double load, double points, int* due) {
    return with(controller, [&](rrcb::Controller& own) { store(own.step(load, points), due); });
}

int rrcb_controller_due(const rrcb_controller* controller, int* due) {
    return with(controller, [&](const rrcb::Controller& own) { store(own.due(), due); });
}

int rrcb_controller_rebalanced(rrcb_controller* controller, const rrcb_report* report,
                               double cost) {
    return with(controller, [&](rrcb::Controller& own) {
        rrcb::Report known;
        if (report != nullptr) known.details.least_imbalance = report->least_imbalance;
        own.rebalanced(known, cost);
    });
}
