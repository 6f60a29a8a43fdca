#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/meeting_mpi.hpp"
#include "controller/controller_state_mpi.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Joins the messages of two ranks. A message is a StepRecord, followed by the sums of a cost
/// model.
void join_messages(void* in, void* inout, int* count, MPI_Datatype* type) {
    int bytes = 0;
    MPI_Type_size(*type, &bytes);
    const std::size_t length = static_cast<std::size_t>(bytes) / sizeof(double);
    const auto* theirs = static_cast<const double*>(in);
    auto* ours = static_cast<double*>(inout);
    for (int i = 0; i < *count; ++i, theirs += length, ours += length) {
        join(*reinterpret_cast<const StepRecord*>(theirs), *reinterpret_cast<StepRecord*>(ours));
        constexpr std::size_t begin = sizeof(StepRecord) / sizeof(double);
        join_carried({theirs + begin, length - begin}, {ours + begin, length - begin});
    }
}

}  // namespace

Controller::State& Controller::State::of(const Controller& controller) {
    if (controller.state_ == nullptr)
        throw Error(ErrorCode::invalid_argument,
                    "the controller was moved from; use the one that it was moved to");
    return *controller.state_;
}

void Controller::State::open(MPI_Comm comm) {
    comm_ = comm;
    rank_ = mpi::rank_of(comm_);
    num_ranks_ = mpi::size_of(comm_);
    message_ = std::make_unique<StepMessage>(0);
    reduction_ = std::make_unique<mpi::Owned<MPI_Op, MPI_Op_free>>(
        [](MPI_Op* made) { return MPI_Op_create(join_messages, 1, made); }, "MPI_Op_create");
    mpi::check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, close, &key_, nullptr),
               "MPI_Comm_create_keyval");
    mpi::check(MPI_Comm_set_attr(MPI_COMM_SELF, key_, this), "MPI_Comm_set_attr");
    closes_itself_ = true;
}

void Controller::State::check_usable() const {
    if (log_->end != CallLog::End::none)
        throw Error(ErrorCode::mpi, log_->why + " (make another controller)");
}

void Controller::State::begin_step(CallName call) {
    check_usable();
    log_->add(call);
}

Participant Controller::State::enter(CallName call) {
    check_usable();
    log_->begin(call);
    return {comm_, log_};
}

void Controller::State::check_free() const {
    const bool has_steps = has_started_ && !is_restored_;
    if (has_steps || !carried().empty())
        throw Error(ErrorCode::invalid_argument,
                    has_steps ? "the controller has recorded steps; make the cost model before"
                              : "the controller has a cost model already; make another one");
}

int Controller::State::close(MPI_Comm, int, void* state, void*) {
    static_cast<State*>(state)->close();
    return MPI_SUCCESS;
}

void Controller::State::close() {
    if (comm_ == MPI_COMM_NULL) return;
    if (log_->end != CallLog::End::none) {
        // The reduction may still be pending after this, so its operation and memory must not be
        // freed.
        reduction_.release();
        message_.release();
        comm_ = MPI_COMM_NULL;
        return;
    }
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    reduction_.reset();
    message_.reset();
    MPI_Comm_free(&comm_);
}

Controller::State::~State() {
    if (comm_ == MPI_COMM_NULL) return;
    if (closes_itself_) MPI_Comm_delete_attr(MPI_COMM_SELF, key_);
    close();
    if (key_ != MPI_KEYVAL_INVALID) MPI_Comm_free_keyval(&key_);
}

void Controller::State::change_weights() {
    rule_.expect_less();
    point_cost = {};
}

void Controller::State::report(double cost, const ReportDetails& details) {
    cost_ += cost;
    has_bad_cost_ = has_bad_cost_ || !is_amount(cost) || !is_amount(cost_);
    least_imbalance_ = details.least_imbalance;
    num_points_ = static_cast<double>(details.num_points);
    total_weight_ = details.all_weights_zero ? num_points_ : details.total_weight;
    ++num_rebalances_;
    is_due = false;
}

StepRecord Controller::State::hand_in(const RankLoad& load, BadInput fault) {
    const bool has_bad_load =
        !is_amount(load.measured) || !is_amount(load.smoothed) || fault != BadInput::none;
    if (fault == BadInput::none && has_bad_load) fault = BadInput::load;
    if (fault == BadInput::none && has_bad_cost_) fault = BadInput::cost;
    StepRecord mine;
    mine.work = has_bad_load ? 0 : load.measured / num_ranks_;
    mine.mean_load = has_bad_load ? 0 : load.smoothed / num_ranks_;
    mine.weight = has_bad_load ? 0 : load.weight / num_ranks_;
    mine.heaviest_load = has_bad_load ? 0 : load.smoothed;
    mine.cost = has_bad_cost_ ? 0 : cost_;
    mine.least_imbalance = least_imbalance_;
    mine.is_due = root_asks_ ? 1 : 0;
    if (fault != BadInput::none) mine.bad_input = code_of(rank_, fault);
    mine.num_rebalances = num_rebalances_;
    mine.minus_num_rebalances = -num_rebalances_;
    mine.offered = std::exchange(offered_, none_offered);
    cost_ = 0;
    has_bad_cost_ = false;
    root_asks_ = false;
    return mine;
}

void Controller::State::take(const StepRecord& all) {
    check_record(all);
    largest_ = all.offered;
    // A decision is out of date if the ranks have rebalanced since its loads.
    is_due = all.is_due > 0 && all.num_rebalances == num_heeded_ &&
             all.num_rebalances == num_rebalances_;
    num_heeded_ = all.num_rebalances;
    // Compared with a margin, because points may have been created or removed since the balance.
    const double counted = std::abs(all.weight - num_points_ / num_ranks_);
    counts_points = counted < 0.1 * std::abs(all.weight - total_weight_ / num_ranks_);
    if (rank_ == root) follow(all);
}

void Controller::State::follow(const StepRecord& all) {
    if (all.num_rebalances > num_followed_) {
        rule_.rebalanced(all.cost, all.least_imbalance);
        num_followed_ = all.num_rebalances;
    }
    rule_.add(smoothed_load(all.work, all.mean_load, all.heaviest_load));
    if (num_to_skip_ > 0) {
        --num_to_skip_;
        return;
    }
    root_asks_ = rule_.is_due();
    if (root_asks_) num_to_skip_ = 2;
}

void Controller::State::start(const RankLoad& load, std::span<const double> carried,
                              BadInput fault) {
    auto& [type, mine, all] = *message_;
    *reinterpret_cast<StepRecord*>(mine.data()) = hand_in(load, fault);
    const auto end = std::ranges::copy(carried, mine.begin() + StepMessage::num_doubles).out;
    std::fill(end, mine.end(), 0.0);
    has_started_ = true;
    is_restored_ = false;
    mpi::check(
        MPI_Iallreduce(mine.data(), all.data(), 1, type.get(), reduction_->get(), comm_, &request_),
        "MPI_Iallreduce");
}

void Controller::State::exchange(double* number) {
    if (number == nullptr) return;
    offered_ = std::isnan(*number) ? -none_offered : *number;
    *number = largest_;
}

void Controller::State::finish() {
    mpi::check_is_running();
    is_due = false;
    if (!has_started_) return;
    mpi::check(wait_watched(request_, *log_), "MPI_Wait");
    take(*reinterpret_cast<const StepRecord*>(message_->all.data()));
}

std::unique_ptr<Controller::State> Controller::State::make(MPI_Comm comm, CallName call) {
    Participant self = mpi::enter(comm, call);
    agree(self);
    std::unique_ptr<State> state;
    MPI_Comm own = MPI_COMM_NULL;
    self.check(MPI_Comm_dup(self.comm, &own), "MPI_Comm_dup");
    self.attempt([&] {
        state = std::make_unique<State>(self.log);
        state->open(own);
    });
    try {
        agree(self);
    } catch (...) {
        if (!state && own != MPI_COMM_NULL) MPI_Comm_free(&own);
        throw;
    }
    return state;
}

Controller::Controller(MPI_Comm comm) : Controller(State::make(comm, CallName::controller)) {}
Controller::Controller(std::unique_ptr<State> state) : state_(std::move(state)) {}
Controller::~Controller() = default;
Controller::Controller(Controller&&) noexcept = default;
Controller& Controller::operator=(Controller&&) noexcept = default;

bool Controller::step(const Step& step) {
    const NonStop arithmetic;
    State& state = State::of(*this);
    state.begin_step(CallName::controller_step);
    state.finish();
    state.exchange(step.largest);
    if (!step.weight) {
        state.start({step.load, step.load});
        return state.is_due;
    }
    const bool is_legal = is_amount(step.load) && is_amount(*step.weight);
    double smoothed = is_legal ? state.point_cost.smoothed(step.load, *step.weight) : -1;
    if (is_legal && state.counts_points) smoothed = step.load;
    state.start({step.load, smoothed, *step.weight});
    return state.is_due;
}

bool Controller::due() const {
    return State::of(*this).is_due;
}

void Controller::rebalanced(const Rebalance& rebalance) {
    State::of(*this).report(
        rebalance.cost, rebalance.report != nullptr ? rebalance.report->details : ReportDetails{});
}

}  // namespace rrcb
