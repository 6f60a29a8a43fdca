#include "c/balancer.hpp"
#include "c/for_experimental.h"
#include "c/for_fortran.h"
#include "c/handle_mpi.hpp"
#include "c/sized.hpp"
#include "options/rejection.hpp"

#include <rrcb/controller.hpp>
#include <rrcb/experimental/cost.hpp>
#include <rrcb/restart.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

struct rrcb_controller {
    static constexpr const char* name = "controller";
    std::optional<rrcb::Controller> controller{};
    std::vector<std::byte> saved{};
};

struct rrcb_cost_model {
    static constexpr const char* name = "model";
    std::optional<rrcb::experimental::CostModel> model{};
    std::string report{};
    std::vector<std::byte> saved{};
};

namespace {

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::saved_bytes;
using rrcb::c::view;

void store(bool is_due, int* due) {
    if (due != nullptr) *due = is_due ? 1 : 0;
}

/// Makes a cost model. If the address of a controller is given, the model belongs to that
/// controller, otherwise to the communicator. `make` gets one of the two. Collective.
template <class Make>
int make_model(MPI_Comm comm, rrcb_controller* const* controller, CallName call,
               rrcb_cost_model** model, Make&& make) {
    const auto body = [&] {
        Participant self = rrcb::mpi::enter(comm, call);
        auto made = rrcb::c::make_handle(
            self, model, {{"whether a controller is given", controller != nullptr}}, [&] {
                if (controller != nullptr) rrcb::c::require(*controller, "controller");
            });
        if (controller == nullptr)
            made->model.emplace(make(comm));
        else
            made->model.emplace(make(*(*controller)->controller));
        *model = made.release();
    };
    return guarded(body, {comm, rrcb::c::patience_together});
}

int make_new_model(MPI_Comm comm, rrcb_controller* const* controller, int num_columns,
                   rrcb_cost_model** model) {
    return make_model(comm, controller, CallName::cost_model, model, [&](auto& where) {
        return rrcb::experimental::CostModel(where, num_columns);
    });
}

int load_model(MPI_Comm comm, rrcb_controller* const* controller, const void* bytes, size_t size,
               rrcb_cost_model** model) {
    return make_model(comm, controller, CallName::load, model, [&](auto& where) {
        return rrcb::experimental::load_cost_model(saved_bytes(bytes, size), where);
    });
}

/// Saves the object that a handle refers to. Collective.
template <class Handle, class Object>
void save(Handle& own, const Object& object, const void** bytes, size_t* size) {
    own.saved = save(object);
    if (bytes != nullptr && size != nullptr) rrcb::c::show(own.saved, bytes, size);
    rrcb::c::require(bytes, "bytes");
    rrcb::c::require(size, "size");
}

void check_columns(const rrcb_cost_model& own, std::size_t num_columns) {
    const std::size_t expected = own.model->costs().size();
    if (num_columns != expected)
        rrcb::reject("the cost model has " + std::to_string(expected) + " columns, not " +
                     std::to_string(num_columns) + "; give as many");
}

}  // namespace

int rrcb_controller_create(MPI_Comm comm, rrcb_controller** controller) {
    return rrcb::c::create(comm, CallName::controller, controller,
                           [&](auto& own) { own.controller.emplace(comm); });
}

int rrcb_controller_create_fortran(int comm, rrcb_controller** controller) {
    return rrcb_controller_create(rrcb::c::comm_of(comm), controller);
}

int rrcb_controller_save(rrcb_controller* controller, const void** bytes, size_t* size) {
    return guarded(controller, [&](auto& own) { save(own, *own.controller, bytes, size); });
}

int rrcb_controller_load(MPI_Comm comm, const void* bytes, size_t size,
                         rrcb_controller** controller) {
    return rrcb::c::create(comm, CallName::load, controller, [&](auto& own) {
        own.controller.emplace(rrcb::load<rrcb::Controller>(saved_bytes(bytes, size), comm));
    });
}

int rrcb_controller_load_fortran(int comm, const void* bytes, size_t size,
                                 rrcb_controller** controller) {
    return rrcb_controller_load(rrcb::c::comm_of(comm), bytes, size, controller);
}

void rrcb_controller_destroy(rrcb_controller** controller) {
    rrcb::c::destroy(controller);
}

int rrcb_controller_step(rrcb_controller* controller, double load, const double* weight, int* due) {
    return guarded(controller, [&](auto& own) {
        rrcb::Controller::Step step{.load = load};
        if (weight != nullptr) step.weight = *weight;
        store(own.controller->step(step), due);
    });
}

int rrcb_controller_due(const rrcb_controller* controller, int* due) {
    return guarded(controller, [&](const auto& own) { store(own.controller->due(), due); });
}

int rrcb_controller_rebalanced(rrcb_controller* controller, const rrcb_report* report,
                               double cost) {
    return guarded(controller, [&](auto& own) {
        rrcb::Report known;
        if (report != nullptr) {
            const rrcb_report given = rrcb::c::copy_in(report, "report");
            if (!(given.least_imbalance >= 1))
                rrcb::reject("report is of no balance; fill it by rrcb_get_report");
            known.details.least_imbalance = given.least_imbalance;
            known.details.num_points = given.num_points;
            known.details.total_weight = given.total_weight;
            known.details.all_weights_zero = given.all_weights_zero != 0;
        }
        own.controller->rebalanced({.cost = cost, .report = &known});
    });
}

int rrcb_cost_model_create(MPI_Comm comm, rrcb_controller* controller, int num_columns,
                           rrcb_cost_model** model) {
    return make_new_model(comm, controller == nullptr ? nullptr : &controller, num_columns, model);
}

int rrcb_cost_model_create_fortran(int comm, rrcb_controller* const* controller, int num_columns,
                                   rrcb_cost_model** model) {
    return make_new_model(rrcb::c::comm_of(comm), controller, num_columns, model);
}

int rrcb_cost_model_save(rrcb_cost_model* model, const void** bytes, size_t* size) {
    return guarded(model, [&](auto& own) { save(own, *own.model, bytes, size); });
}

int rrcb_cost_model_load(MPI_Comm comm, rrcb_controller* controller, const void* bytes, size_t size,
                         rrcb_cost_model** model) {
    return load_model(comm, controller == nullptr ? nullptr : &controller, bytes, size, model);
}

int rrcb_cost_model_load_fortran(int comm, rrcb_controller* const* controller, const void* bytes,
                                 size_t size, rrcb_cost_model** model) {
    return load_model(rrcb::c::comm_of(comm), controller, bytes, size, model);
}

void rrcb_cost_model_destroy(rrcb_cost_model** model) {
    rrcb::c::destroy(model);
}

int rrcb_cost_model_step(rrcb_cost_model* model, double seconds, size_t num_columns,
                         const double* columns) {
    return guarded(model, [&](auto& own) { own.model->step(seconds, view(columns, num_columns)); });
}

int rrcb_cost_model_weights(rrcb_cost_model* model, size_t count, size_t num_columns,
                            const double* columns, double* weights) {
    return guarded(model, [&](auto& own) {
        check_columns(own, num_columns);
        if (count > PTRDIFF_MAX / sizeof(double) / num_columns)
            rrcb::reject(
                "count and columns exceed the memory; count is the number of points of this rank");
        rrcb::c::require_array(count, columns, "columns");
        rrcb::c::require_array(count, weights, "weights");
        std::ranges::copy(own.model->weights(view(columns, count * num_columns)), weights);
    });
}

int rrcb_cost_model_num_columns(const rrcb_cost_model* model, int* num_columns) {
    return guarded(model, [&](const auto& own) {
        rrcb::c::require(num_columns, "num_columns");
        *num_columns = static_cast<int>(own.model->costs().size());
    });
}

int rrcb_cost_model_costs(const rrcb_cost_model* model, size_t num_columns, double* costs) {
    return guarded(model, [&](const auto& own) {
        check_columns(own, num_columns);
        rrcb::c::require(costs, "costs");
        std::ranges::copy(own.model->costs(), costs);
    });
}

int rrcb_cost_model_uses_costs(const rrcb_cost_model* model, int* uses_costs) {
    return guarded(model, [&](const auto& own) { store(own.model->uses_costs(), uses_costs); });
}

const char* rrcb_cost_model_report(rrcb_cost_model* model) {
    const int code = guarded(model, [](auto& own) { own.report = own.model->report(); });
    return code == RRCB_OK ? model->report.c_str() : "";
}
