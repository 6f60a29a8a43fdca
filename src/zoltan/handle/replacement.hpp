#pragma once

#include "zoltan/handle/state.hpp"

#include <string>

namespace rrcb::zoltan {

/// Marks a call of the real Zoltan's partitioning, for a handle with `outer` (null: unknown).
/// Handles created while one is under way are Zoltan's own, of HIER or PHG for instance.
class InsideZoltan {
  public:
    explicit InsideZoltan(const State* outer) noexcept;
    ~InsideZoltan();
    InsideZoltan(const InsideZoltan&) = delete;
    InsideZoltan& operator=(const InsideZoltan&) = delete;

  private:
    const State* outer_before_;
    bool inside_before_;
};

/// Returns LB_METHOD in the form in which Zoltan compares it.
std::string method_of(const State& state);

/// Returns whether RRCB_REPLACE=RCB is in the environment of this process; another value is warned
/// about.
bool is_replacement_asked();

/// Parameters of a handle that is just created. Zoltan's own handles get those that HIER writes
/// without Zoltan_Set_Param: the outer OBJ_WEIGHT_DIM and DEBUG_LEVEL, and REMAP=0.
Parameters initial_parameters();

/// Returns whether a handle that is just created is for a level of HIER.
bool is_inside_hier();

/// Makes a handle that is just created answer LB_METHOD=RCB, also as Zoltan's default, with RRCB,
/// unless it is one of Zoltan's own.
void replace_rcb(State& state) noexcept;

/// Prints once in a process, on rank 0, that Zoltan answers a geometric method although its
/// replacement was asked for. `state` may be null.
void tell_if_not_replaced(const State* state, const char* function) noexcept;

}  // namespace rrcb::zoltan
