#include "collective/agreement_mpi.hpp"
#include "collective/saved_state_mpi.hpp"
#include "controller/controller_state_mpi.hpp"
#include "controller/cost_rule.hpp"
#include "options/rejection.hpp"

#include <rrcb/error.hpp>
#include <rrcb/experimental/cost.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace rrcb::experimental {

namespace {

bool is_number(double value) {
    // The squares of such numbers and the sums of squares do not overflow.
    return is_amount(value) && value <= 1e100;
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
    return text;
}

std::string report_of(const CostRule& rule) {
    const std::string errors = percent(rule.learned_error()) + " of the mean, counting by " +
                               percent(rule.counted_error());
    switch (rule.state()) {
        case CostState::learned:
            return "learned costs are used: they miss the seconds of a rank by " + errors;
        case CostState::no_better:
            return "points are counted: learned costs miss the seconds of a rank by " + errors +
                   ", which is too near";
        case CostState::harmful:
            return "points are counted: with learned costs the slowest rank took longer; they are "
                   "tried again later";
        case CostState::one_rank:
            return "points are counted: there is one rank only";
        case CostState::too_early:
            break;
    }
    return "points are counted: too few steps were recorded";
}

void check_columns(int num_columns) {
    if (num_columns < 1 || num_columns > most_cost_columns)
        throw Error(ErrorCode::invalid_argument,
                    "a cost model has 1 to " + std::to_string(most_cost_columns) +
                        " columns, not " + std::to_string(num_columns) + "; add up some of them");
}

}  // namespace

struct CostModel::State {
    Controller::State& reducer;
    CostRule rule;
    std::optional<Controller> own{};  ///< the model's own controller, if the caller has given none
    int num_ranks_before = 0;  ///< number of ranks on which loaded costs were saved, if it was
                               ///< another one; otherwise 0

    /// Makes a model; if `saved` is not null, restores it from there. Collective.
    static std::unique_ptr<State> make(Controller& controller, CallName call, int num_columns,
                                       const std::span<const std::byte>* saved);

    /// Makes a controller for a model without one. Collective.
    static Controller own_controller(MPI_Comm comm, CallName call) {
        return Controller(Controller::State::make(comm, call));
    }

    /// Writes or reads everything except the numbers that differ between ranks. Returns whether the
    /// saved model had the present number of ranks.
    bool store(SavedState& state, StepMessage& message);

    /// Returns the state of a model. Throws Error if the model has been moved from.
    static State& of(const CostModel& model) {
        if (model.state_ == nullptr)
            throw Error(ErrorCode::invalid_argument,
                        "the cost model was moved from; use the one that it was moved to");
        return *model.state_;
    }
};

bool CostModel::State::store(SavedState& state, StepMessage& message) {
    int num_ranks = reducer.num_ranks();
    bool is_pending = reducer.has_started();
    state.each(num_ranks, is_pending);
    const bool is_same = num_ranks == reducer.num_ranks();
    auto sums = std::span(message.all).subspan(StepMessage::num_doubles);
    if (is_pending) state.each(sums);
    rule.store(state);
    if (is_same) return is_pending;
    std::ranges::fill(sums, 0.0);
    rule.change_ranks(num_ranks);
    num_ranks_before = num_ranks;
    return false;
}

std::unique_ptr<CostModel::State> CostModel::State::make(Controller& controller, CallName call,
                                                         int num_columns,
                                                         const std::span<const std::byte>* saved) {
    Controller::State& reducer = Controller::State::of(controller);
    Participant self = reducer.enter(call);
    std::unique_ptr<State> made;
    std::unique_ptr<StepMessage> message;
    bool is_pending = false;
    self.attempt([&] {
        std::optional<SavedState> state;
        if (saved != nullptr) state.emplace(*saved, StateKind::cost_model).each(num_columns);
        check_columns(num_columns);
        reducer.check_free();
        made.reset(new State{reducer, {num_columns, reducer.rank(), reducer.num_ranks()}});
        message = std::make_unique<StepMessage>(made->rule.num_sums());
        if (!state) return;
        is_pending = made->store(*state, *message);
        if (made->num_ranks_before == 0)
            made->rule.set_own_numbers(numbers_of_rank(*state, reducer.rank()));
    });
    const std::uint64_t hash = saved != nullptr ? hash_of_bytes(*saved) : 0;
    agree(self, {{"the number of columns", static_cast<std::uint64_t>(num_columns)},
                 {"the saved state", hash}});
    reducer.carry(std::move(message));
    if (is_pending) reducer.resume();
    return made;
}

CostModel::CostModel(MPI_Comm comm, int num_columns) {
    Controller own = State::own_controller(comm, CallName::cost_model);
    *this = CostModel(own, num_columns);
    state_->own = std::move(own);
}

CostModel::CostModel(Controller& controller, int num_columns)
    : state_(State::make(controller, CallName::cost_model, num_columns, nullptr)) {}

CostModel::CostModel(std::unique_ptr<State> state) : state_(std::move(state)) {}
CostModel::~CostModel() = default;
CostModel::CostModel(CostModel&&) noexcept = default;
CostModel& CostModel::operator=(CostModel&&) noexcept = default;

void CostModel::step(double seconds, std::span<const double> columns, double* largest) {
    const NonStop arithmetic;
    State& state = State::of(*this);
    auto& [reducer, rule, own, num_ranks_before] = state;
    reducer.begin_step(CallName::cost_model_step);
    reducer.finish();
    reducer.exchange(largest);
    if (reducer.has_started()) {
        const bool used_costs = rule.uses_costs();
        rule.take(reducer.carried());
        if (rule.uses_costs() != used_costs) reducer.change_weights();
    }
    if (columns.size() != rule.num_columns()) return reducer.start({}, {}, BadInput::columns);
    if (!is_number(seconds) || !std::ranges::all_of(columns, is_number))
        return reducer.start({}, {}, BadInput::load);
    const double points = rule.uses_costs() ? rule.weight(columns) : columns[0];
    const double load = reducer.point_cost.smoothed(seconds, points);
    reducer.start({seconds, load}, rule.hand_in(seconds, columns));
}

std::vector<double> CostModel::costs() const {
    const CostVector& costs = State::of(*this).rule.costs();
    return locally([&] { return std::vector<double>(costs.begin(), costs.end()); });
}

bool CostModel::uses_costs() const {
    return State::of(*this).rule.uses_costs();
}

std::vector<double> CostModel::weights(std::span<const double> columns) {
    const NonStop arithmetic;
    CostRule& rule = State::of(*this).rule;
    rule.divide();
    const std::size_t length = rule.num_columns();
    return locally([&] {
        if (columns.size() % length != 0)
            throw Error(ErrorCode::invalid_argument,
                        "columns has " + std::to_string(columns.size()) +
                            " numbers; give a row for each point, of as many numbers as the model "
                            "has columns, " +
                            std::to_string(length));
        std::vector<double> weights(columns.size() / length, 1.0);
        if (!rule.uses_costs()) return weights;
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = rule.weight(columns.subspan(i * length, length));
        return weights;
    });
}

std::string CostModel::report() const {
    return locally([&] {
        const State& state = State::of(*this);
        const std::string text = report_of(state.rule);
        if (state.num_ranks_before == 0) return text;
        return text + "; loaded from " + std::to_string(state.num_ranks_before) +
               " ranks: the controller and the errors of ranks began anew";
    });
}

std::vector<std::byte> save(const CostModel& model) {
    CostModel::State& state = CostModel::State::of(model);
    Participant self = state.reducer.enter(CallName::save);
    return save_together(
        StateKind::cost_model, state.rule.own_numbers(), [&] { state.reducer.wait(self); },
        [&](SavedState& to) {
            auto num_columns = state.rule.num_columns();
            to.each(num_columns);
            state.store(to, state.reducer.message());
        },
        self);
}

CostModel load_cost_model(std::span<const std::byte> bytes, Controller& controller) {
    return CostModel(CostModel::State::make(controller, CallName::load, 0, &bytes));
}

CostModel load_cost_model(std::span<const std::byte> bytes, MPI_Comm comm) {
    Controller own = CostModel::State::own_controller(comm, CallName::load);
    CostModel model = load_cost_model(bytes, own);
    model.state_->own = std::move(own);
    return model;
}

}  // namespace rrcb::experimental
