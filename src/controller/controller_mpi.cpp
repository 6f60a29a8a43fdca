#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/handles.hpp"
#include "controller/rebalance_rule.hpp"

#include <rrcb/controller.hpp>
#include <rrcb/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace rrcb {

namespace {

/// Of one rank in one step, or of all: the means add up, of the rest the largest counts. A
/// smallest value travels as the largest of its negative.
struct StepRecord {
    double mean_load = 0;  ///< this rank's share of it
    double heaviest_load = 0;
    double cost = 0;  ///< of the rebalances since the step before
    double least_imbalance = 1;
    double is_due = 0;     ///< the root's decision; 0 from all others
    double bad_input = 0;  ///< 2 rank + 1 for a load, + 2 for a cost
    double number = 0;
    double minus_number = 0;
    double num_rebalances = 0;
    double minus_num_rebalances = 0;
};

constexpr int num_doubles = sizeof(StepRecord) / sizeof(double);

void reduce_records(void* in, void* inout, int* count, MPI_Datatype*) {
    const double* theirs = static_cast<double*>(in);
    double* ours = static_cast<double*>(inout);
    for (int i = 0; i < *count * num_doubles; ++i)
        ours[i] = i % num_doubles == 0 ? ours[i] + theirs[i] : std::max(ours[i], theirs[i]);
}

bool is_amount(double value) {
    return std::isfinite(value) && value >= 0;
}

std::string whole(double number) {
    return std::to_string(static_cast<std::int64_t>(number));
}

/// Throws what is wrong with a step, the same on every rank.
void check_record(const StepRecord& all) {
    std::string text;
    if (all.number != -all.minus_number) {
        text = "the controller is at step " + whole(-all.minus_number) + " on one rank and at " +
               whole(all.number) + " on another; call it once for each step on every rank";
    } else if (all.num_rebalances != -all.minus_num_rebalances) {
        text = "rebalanced() was called " + whole(-all.minus_num_rebalances) +
               " times on one rank and " + whole(all.num_rebalances) +
               " times on another; call it on every rank after each rebalance";
    } else if (all.bad_input > 0) {
        const auto code = static_cast<std::int64_t>(all.bad_input);
        text = "rank " + std::to_string((code - 1) / 2) +
               (code % 2 == 1 ? ": the load of step " + whole(all.number)
                              : ": the cost of a rebalance before step " + whole(all.number)) +
               " is negative, NaN or infinite; give a finite number of at least 0";
    }
    if (!text.empty()) throw Error(ErrorCode::invalid_argument, text);
}

}  // namespace

struct Controller::State {
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    /// Owns the communicator from now on, also where it throws.
    void open(MPI_Comm comm);
    void start(std::int64_t number, double load);
    /// Takes the result of the reduction under way; whether it says to rebalance.
    bool finish();
    void report(double cost, double least);

  private:
    static int close(MPI_Comm, int, void* state, void*);
    void close();
    void follow(const StepRecord& all);

    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int num_ranks_ = 1;
    int key_ = MPI_KEYVAL_INVALID;  ///< of an attribute of MPI_COMM_SELF: its deletion closes this
    bool closes_itself_ = false;    ///< the attribute is set
    std::optional<mpi::ContiguousType> type_;
    std::optional<mpi::Reduction> reduction_;
    MPI_Request request_ = MPI_REQUEST_NULL;
    StepRecord mine_;  ///< handed in; stays until the reduction is done
    StepRecord all_;   ///< its result

    double cost_ = 0;  ///< of the rebalances since the last step
    bool has_bad_cost_ = false;
    double least_imbalance_ = 1;
    double num_rebalances_ = 0;

    double num_heeded_ = 0;    ///< rebalances that the latest decision knew of, on all ranks
    RebalanceRule rule_;       ///< fed on the root alone, as are those below
    double num_followed_ = 0;  ///< rebalances that it knows of
    bool is_due_ = false;
    int num_to_skip_ = 0;  ///< steps that end before a decision made can be heeded
};

void Controller::State::open(MPI_Comm comm) {
    comm_ = comm;
    rank_ = mpi::rank_of(comm_);
    num_ranks_ = mpi::size_of(comm_);
    type_.emplace(num_doubles, MPI_DOUBLE);
    reduction_.emplace(reduce_records);
    mpi::check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, close, &key_, nullptr),
               "MPI_Comm_create_keyval");
    mpi::check(MPI_Comm_set_attr(MPI_COMM_SELF, key_, this), "MPI_Comm_set_attr");
    closes_itself_ = true;
}

int Controller::State::close(MPI_Comm, int, void* state, void*) {
    static_cast<State*>(state)->close();
    return MPI_SUCCESS;
}

void Controller::State::close() {
    if (comm_ == MPI_COMM_NULL) return;
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    reduction_.reset();
    type_.reset();
    MPI_Comm_free(&comm_);
}

Controller::State::~State() {
    if (comm_ == MPI_COMM_NULL) return;
    if (closes_itself_) MPI_Comm_delete_attr(MPI_COMM_SELF, key_);
    close();
    if (key_ != MPI_KEYVAL_INVALID) MPI_Comm_free_keyval(&key_);
}

void Controller::State::report(double cost, double least) {
    cost_ += cost;
    has_bad_cost_ = has_bad_cost_ || !is_amount(cost) || !is_amount(cost_);
    least_imbalance_ = least;
    ++num_rebalances_;
}

void Controller::State::start(std::int64_t number, double load) {
    const bool has_bad_load = !is_amount(load);
    mine_.mean_load = has_bad_load ? 0 : load / num_ranks_;
    mine_.heaviest_load = has_bad_load ? 0 : load;
    mine_.cost = has_bad_cost_ ? 0 : cost_;
    mine_.least_imbalance = least_imbalance_;
    mine_.is_due = is_due_ ? 1 : 0;
    mine_.bad_input = has_bad_load ? 2 * rank_ + 1 : has_bad_cost_ ? 2 * rank_ + 2 : 0;
    mine_.number = static_cast<double>(number);
    mine_.minus_number = -mine_.number;
    mine_.num_rebalances = num_rebalances_;
    mine_.minus_num_rebalances = -num_rebalances_;
    cost_ = 0;
    has_bad_cost_ = false;
    is_due_ = false;
    mpi::check(MPI_Iallreduce(&mine_, &all_, 1, type_->get(), reduction_->get(), comm_, &request_),
               "MPI_Iallreduce");
}

bool Controller::State::finish() {
    const bool is_first = request_ == MPI_REQUEST_NULL;
    mpi::check(MPI_Wait(&request_, MPI_STATUS_IGNORE), "MPI_Wait");
    check_record(all_);
    if (is_first) return false;
    // A decision is out of date where the ranks have rebalanced since.
    const bool is_due = all_.is_due > 0 && all_.num_rebalances == num_heeded_;
    num_heeded_ = all_.num_rebalances;
    if (rank_ == root) follow(all_);
    return is_due;
}

void Controller::State::follow(const StepRecord& all) {
    if (all.num_rebalances > num_followed_) {
        rule_.rebalanced(all.cost, all.least_imbalance);
        num_followed_ = all.num_rebalances;
    }
    rule_.add({all.mean_load, all.heaviest_load});
    if (num_to_skip_ > 0) {
        --num_to_skip_;
        return;
    }
    is_due_ = rule_.is_due();
    if (is_due_) num_to_skip_ = 2;
}

Controller::Controller(MPI_Comm comm) {
    Participant self{mpi::duplicate_of(comm)};
    MPI_Comm own = MPI_COMM_NULL;
    self.check(MPI_Comm_dup(self.comm, &own), "MPI_Comm_dup");
    self.attempt([&] {
        state_ = std::make_unique<State>();
        state_->open(own);
    });
    try {
        agree(self);
    } catch (...) {
        if (!state_ && own != MPI_COMM_NULL) MPI_Comm_free(&own);
        throw;
    }
}

Controller::~Controller() = default;
Controller::Controller(Controller&&) noexcept = default;
Controller& Controller::operator=(Controller&&) noexcept = default;

bool Controller::step(std::int64_t number, double load) {
    const bool is_due = state_->finish();
    state_->start(number, load);
    return is_due;
}

void Controller::rebalanced(const Report& report, double cost) {
    state_->report(cost, report.details.least_imbalance);
}

void Controller::rebalanced(double cost) {
    state_->report(cost, 1);
}

}  // namespace rrcb
