#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/meeting_mpi.hpp"
#include "collective/saved_state_mpi.hpp"
#include "controller/controller_state_mpi.hpp"

#include <rrcb/restart.hpp>

#include <algorithm>
#include <utility>

namespace rrcb {

void Controller::State::carry(std::unique_ptr<StepMessage> message) noexcept {
    // The next step still processes a restored record, so it is copied to the new message.
    std::ranges::copy_n(message_->all.begin(), StepMessage::num_doubles, message->all.begin());
    message_ = std::move(message);
}

void Controller::State::wait(Participant& self) {
    self.check(MPI_Wait(&request_, MPI_STATUS_IGNORE), "MPI_Wait");
}

std::array<double, 3> Controller::State::own_numbers() {
    return {point_cost.load, point_cost.points, cost_};
}

void Controller::State::set_own_numbers(std::span<const double> numbers) {
    point_cost = {numbers[0], numbers[1]};
    cost_ = numbers[2];
    has_bad_cost_ = !is_amount(cost_);
}

void Controller::State::store(SavedState& state) {
    std::span record(message_->all.data(), StepMessage::num_doubles);
    const bool has_numbers = state.has_format(2);
    if (!has_numbers) {
        record.back() = none_offered;
        record = record.first(record.size() - 1);
    }
    state.each(has_started_, record, is_due, counts_points, least_imbalance_, num_points_,
               total_weight_, num_rebalances_, num_heeded_, rule_, num_followed_, root_asks_,
               num_to_skip_);
    if (has_numbers) state.each(largest_);
}

void Controller::State::resume() {
    has_started_ = true;
    is_restored_ = true;
}

std::vector<std::byte> detail::Restart::save(const Controller& controller) {
    Controller::State& state = Controller::State::of(controller);
    Participant self = state.enter(CallName::save);
    return save_together(
        StateKind::controller, state.own_numbers(), [&] { state.wait(self); },
        [&](SavedState& to) {
            int num_ranks = state.num_ranks();
            to.each(num_ranks);
            state.store(to);
        },
        self);
}

Controller detail::Restart::load_controller(std::span<const std::byte> bytes, MPI_Comm comm) {
    auto state = Controller::State::make(comm, CallName::load);
    Participant self = state->enter(CallName::load);
    self.attempt([&] {
        SavedState from(bytes, StateKind::controller);
        int num_ranks = 0;
        from.each(num_ranks);
        if (num_ranks != state->num_ranks()) return;
        state->store(from);
        state->set_own_numbers(numbers_of_rank(from, state->rank()));
        if (state->has_started()) state->resume();
    });
    agree(self, {{"the saved state", hash_of_bytes(bytes)}});
    return Controller(std::move(state));
}

}  // namespace rrcb
