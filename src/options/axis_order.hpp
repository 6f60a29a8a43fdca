#pragma once

#include <rrcb/options.hpp>

#include <vector>

namespace rrcb {

namespace detail {

/// Reads how an order of axes was made.
struct AxisOrderAccess {
    using Kind = AxisOrder::Kind;
    static Kind kind_of(const AxisOrder& order) { return order.kind_; }
    static const std::vector<int>& axes_of(const AxisOrder& order) { return order.axes_; }
};

}  // namespace detail

inline bool is_longest(const AxisOrder& order) {
    using detail::AxisOrderAccess;
    return AxisOrderAccess::kind_of(order) == AxisOrderAccess::Kind::longest;
}
inline bool is_among(const AxisOrder& order) {
    using detail::AxisOrderAccess;
    return AxisOrderAccess::kind_of(order) == AxisOrderAccess::Kind::among;
}
inline bool is_grouped(const AxisOrder& order) {
    using detail::AxisOrderAccess;
    return AxisOrderAccess::kind_of(order) == AxisOrderAccess::Kind::grouped;
}
inline bool is_given(const AxisOrder& order) {
    using detail::AxisOrderAccess;
    return AxisOrderAccess::kind_of(order) == AxisOrderAccess::Kind::given;
}

/// Returns the axes that were given to an order; empty for fewest_ghosts() and longest().
inline const std::vector<int>& axes_in(const AxisOrder& order) {
    return detail::AxisOrderAccess::axes_of(order);
}

}  // namespace rrcb
