#pragma once

#include "zoltan/handle/state.hpp"

#include <string>

namespace rrcb::zoltan {

/// Marks a partitioning call of the real Zoltan for a handle with the state `outer`, which may be
/// null. Handles that are created during the call are Zoltan's own, for example those of HIER or
/// PHG.
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

/// Returns whether RRCB_REPLACE=RCB is in the environment of this process. Warns about any other
/// value.
bool is_replacement_asked();

/// Returns the parameters of a handle that has just been created. Zoltan's own handles get those
/// that HIER sets without Zoltan_Set_Param: OBJ_WEIGHT_DIM and DEBUG_LEVEL of the outer handle, and
/// REMAP=0.
Parameters initial_parameters();

/// Returns whether a handle that has just been created is for a level of HIER.
bool is_inside_hier();

/// Lets RRCB answer for LB_METHOD=RCB in a handle that has just been created, also if RCB is only
/// Zoltan's default. Does nothing if the handle is Zoltan's own.
void replace_rcb(State& state) noexcept;

/// Prints on rank 0, once in a process, that Zoltan answers for a geometric method although its
/// replacement was asked for. `state` may be null.
void tell_if_not_replaced(const State* state, const char* function) noexcept;

}  // namespace rrcb::zoltan
