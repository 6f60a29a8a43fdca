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

/// Load of this rank in a step, as measured and without the noise of the clock.
struct RankLoad {
    double measured = 0;
    double smoothed = 0;
    double weight = 0;  ///< given by the caller; 0 if none was
};

/// Record of a rank's step, its sums, and the result of all ranks.
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
    std::vector<double> mine;  ///< unchanged until the reduction is done
    std::vector<double> all;
};

/// Reduces the steps of all ranks, and applies the rule on the root. Its decision is sent with the
/// next reduction, so the ranks agree even if they round a sum differently.
///
/// start() and finish() reduce on a communicator of their own, together with the sums of a cost
/// model.
struct Controller::State {
    /// Makes the state of a controller in a call with `comm`, which other ranks make too.
    /// Collective.
    static std::unique_ptr<State> make(MPI_Comm comm, CallName call);

    explicit State(std::shared_ptr<CallLog> log) : log_(std::move(log)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    /// Returns the state of a controller. Throws Error if it was moved from.
    static State& of(const Controller& controller);

    /// Takes ownership of the communicator, even if it throws.
    void open(MPI_Comm comm);
    /// Notes a step. Throws Error if ranks have made different calls, or were missing.
    void begin_step(CallName call);
    /// Begins a collective call on the communicator of the reductions, as mpi::enter().
    Participant enter(CallName call);
    /// Throws Error if a reduction has started, or carries sums.
    void check_free() const;
    /// Adds the sums that this message has room for to each reduction, joined by join_carried().
    void carry(std::unique_ptr<StepMessage> message) noexcept;
    void start(const RankLoad& load, std::span<const double> carried = {},
               BadInput fault = BadInput::none);
    /// Takes the result of the reduction under way, if there is one.
    void finish();

    /// Returns the joined sums of the ranks' last steps.
    std::span<const double> carried() const {
        return std::span(message_->all).subspan(StepMessage::num_doubles);
    }
    StepMessage& message() { return *message_; }
    bool has_started() const { return has_started_; }
    int rank() const { return rank_; }
    int num_ranks() const { return num_ranks_; }
    /// Notes other weights of points from now on: rebalances may leave less imbalance.
    void change_weights();

    /// Returns this rank's record of a step, and resets the costs for the next.
    StepRecord hand_in(const RankLoad& load, BadInput fault = BadInput::none);
    /// Takes the joined steps of all ranks. Throws the same Error on each.
    void take(const StepRecord& all);

    void report(double cost, const ReportDetails& details);

    /// Returns once the reduction under way is done; its result is not taken.
    void wait(Participant& self);
    /// Numbers of this rank only, for save() and load().
    std::array<double, 3> own_numbers();
    void set_own_numbers(std::span<const double> numbers);
    /// Writes or reads the rest. On the root, when it writes.
    void store(SavedState& state);
    /// Notes that the result of a saved reduction is to be taken by the next step.
    void resume();

    PointCost point_cost;
    bool counts_points = false;  ///< the caller gives numbers although weights were balanced
    bool is_due = false;         ///< on every rank

  private:
    void check_usable() const;
    static int close(MPI_Comm, int, void* state, void*);
    void close();
    void follow(const StepRecord& all);

    std::shared_ptr<CallLog> log_;  ///< of the calls with the caller's communicator
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int num_ranks_ = 1;
    int key_ = MPI_KEYVAL_INVALID;  ///< attribute of MPI_COMM_SELF: its deletion closes this
    bool closes_itself_ = false;    ///< the attribute is set
    std::unique_ptr<StepMessage> message_;
    std::unique_ptr<mpi::Owned<MPI_Op, MPI_Op_free>> reduction_;
    MPI_Request request_ = MPI_REQUEST_NULL;
    bool has_started_ = false;
    bool is_restored_ = false;  ///< and has begun no reduction since

    double cost_ = 0;  ///< of the rebalances since the last step
    bool has_bad_cost_ = false;
    double least_imbalance_ = 1;
    double num_points_ = 0;  ///< of the last balance, as is the next
    double total_weight_ = 0;
    double num_rebalances_ = 0;

    double num_heeded_ = 0;    ///< rebalances known to the latest decision, on all ranks
    RebalanceRule rule_;       ///< gets steps on the root only, as the members below
    double num_followed_ = 0;  ///< rebalances known to the rule
    bool root_asks_ = false;
    int num_to_skip_ = 0;  ///< steps until the ranks can act on a decision
};

}  // namespace rrcb
