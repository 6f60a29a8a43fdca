#pragma once

namespace rrcb::zoltan {

/// Whether RRCB_REPLACE=RCB is in the environment: handles of the program then answer
/// LB_METHOD=RCB, also as Zoltan's default, with RRCB. Read once.
bool replaces_rcb();

/// Marks a call of the real Zoltan's partitioning. Handles created while one is under way are
/// Zoltan's own, of HIER or PHG for instance, and keep their method.
class InsideZoltan {
  public:
    InsideZoltan() noexcept { ++depth_; }
    ~InsideZoltan() { --depth_; }
    InsideZoltan(const InsideZoltan&) = delete;
    InsideZoltan& operator=(const InsideZoltan&) = delete;

    static bool now() noexcept { return depth_ > 0; }

  private:
    static thread_local int depth_;
};

}  // namespace rrcb::zoltan
