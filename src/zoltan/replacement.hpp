#pragma once

#include "state.hpp"

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

/// Parameters of a handle that is just created.
///
/// With RRCB_REPLACE=RCB in the environment handles of the program answer LB_METHOD=RCB, also as
/// Zoltan's default, with RRCB. Zoltan's own keep their method, and get what HIER writes into its
/// handles without Zoltan_Set_Param: the outer OBJ_WEIGHT_DIM and DEBUG_LEVEL, and REMAP=0.
Parameters initial_parameters();

}  // namespace rrcb::zoltan
