#pragma once

#include "collective/handles.hpp"
#include "collective/participant.hpp"
#include "collective/saved_state.hpp"
#include "controller/point_cost.hpp"
#include "controller/rebalance_rule.hpp"
#include "controller/step_record.hpp"

#include <rrcb/controller.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Load of this rank in a step: as measured, and smoothed to remove the noise of the clock.
struct RankLoad {
    double measured = 0;
    double smoothed = 0;
    double weight = 0;  ///< weight of the points; 0 if the caller has given none
};

/// Message of one step: this rank's record and sums, and the result over all ranks.
struct StepMessage {
    static constexpr std::size_t num_doubles = sizeof(StepRecord) / sizeof(double);

    explicit StepMessage(std::size_t num_carried)
        : type([length = static_cast<int>(num_doubles + num_carried)](
                   MPI_Datatype* made) { return MPI_Type_contiguous(length, MPI_DOUBLE, made); },
               "MPI_Type_contiguous"),
          mine(num_doubles + num_carried),
          all(mine) {
        MPI_Datatype committed = type.get();
        mpi::check(MPI_Type_commit(&committed), "MPI_Type_commit");
    }

    mpi::Owned<MPI_Datatype, MPI_Type_free> type;
    std::vector<double> mine;  ///< must not change until the reduction has ended
    std::vector<double> all;
};

/// Reduces the loads of all ranks in each step, and applies the rule on the root. The root's
/// decision is sent with the next reduction, so that all ranks agree even if they round a sum
/// differently.
///
/// start() and finish() use a communicator of their own. They also carry the sums of a cost model.
struct Controller::State {
    /// Makes the state of a controller in a call with `comm`. Collective.
    static std::unique_ptr<State> make(MPI_Comm comm, CallName call);

    explicit State(std::shared_ptr<CallLog> log) : log_(std::move(log)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    /// Returns the state of a controller. Throws Error if the controller has been moved from.
    static State& of(const Controller& controller);

    /// Takes ownership of the communicator, even if it throws.
    void open(MPI_Comm comm);
    /// Notes the beginning of a step. Throws Error if ranks have made different calls or have not
    /// taken part.
    void begin_step(CallName call);
    /// Begins a collective call on the communicator of the reductions, in the way of mpi::enter().
    Participant enter(CallName call);
    /// Throws Error if a reduction has started already, or if it carries sums.
    void check_free() const;
    /// From now on carries the sums for which this message has room; join_carried() joins them.
    void carry(std::unique_ptr<StepMessage> message) noexcept;
    void start(const RankLoad& load, std::span<const double> carried = {},
               BadInput fault = BadInput::none);
    /// Waits for the reduction under way, if there is one, and processes its result.
    void finish();

    /// Sends a number with the next start(), and replaces it by the largest of those that were sent
    /// with the reduction that is done. Does nothing for null.
    void exchange(double* number);

    /// Returns the joined sums of all ranks for the last step.
    std::span<const double> carried() const {
        return std::span(message_->all).subspan(StepMessage::num_doubles);
    }
    StepMessage& message() { return *message_; }
    bool has_started() const { return has_started_; }
    int rank() const { return rank_; }
    int num_ranks() const { return num_ranks_; }
    /// Notes that points have other weights from now on, so that rebalances may leave less
    /// imbalance.
    void change_weights();

    /// Returns this rank's record of a step, and resets the costs of rebalances for the next step.
    StepRecord hand_in(const RankLoad& load, BadInput fault = BadInput::none);
    /// Processes the joined record of all ranks. Throws the same Error on each rank.
    void take(const StepRecord& all);

    void report(double cost, const ReportDetails& details);

    /// Waits for the reduction under way, without processing its result.
    void wait(Participant& self);
    /// For save() and load(): the numbers that differ between ranks.
    std::array<double, 3> own_numbers();
    void set_own_numbers(std::span<const double> numbers);
    /// Writes or reads all other numbers. Writing is only for the root.
    void store(SavedState& state);
    /// Notes that the next step has to process the result of a saved reduction.
    void resume();

    PointCost point_cost;
    bool counts_points = false;  ///< whether the caller passes numbers of points although weights
                                 ///< were balanced
    bool is_due = false;         ///< decision, the same on every rank

  private:
    void check_usable() const;
    static int close(MPI_Comm, int, void* state, void*);
    void close();
    void follow(const StepRecord& all);

    std::shared_ptr<CallLog> log_;  ///< log of the calls with the caller's communicator
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int num_ranks_ = 1;
    int key_ = MPI_KEYVAL_INVALID;  ///< key of an attribute of MPI_COMM_SELF; when it is deleted,
                                    ///< this state is closed
    bool closes_itself_ = false;    ///< whether the attribute is set
    std::unique_ptr<StepMessage> message_;
    std::unique_ptr<mpi::Owned<MPI_Op, MPI_Op_free>> reduction_;
    MPI_Request request_ = MPI_REQUEST_NULL;
    bool has_started_ = false;
    bool is_restored_ = false;  ///< whether the state was loaded and has not started a reduction
                                ///< since

    double offered_ = none_offered;  ///< for the next reduction
    double largest_ = none_offered;  ///< of all ranks, by the latest reduction that is done

    double cost_ = 0;  ///< sum over the rebalances since the last step
    bool has_bad_cost_ = false;
    double least_imbalance_ = 1;
    double num_points_ = 0;    ///< of the last balance
    double total_weight_ = 0;  ///< of the last balance
    double num_rebalances_ = 0;

    double num_heeded_ = 0;  ///< number of rebalances at the latest decision; the same on all ranks
    RebalanceRule rule_;     ///< used on the root only, as are the following members
    double num_followed_ = 0;  ///< number of rebalances that the rule has been told
    bool root_asks_ = false;
    int num_to_skip_ = 0;  ///< number of steps until the ranks can act on a decision
};

}  // namespace rrcb
