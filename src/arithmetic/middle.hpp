#pragma once

namespace rrcb {

/// Returns the middle of two coordinates, or `above` if no double is between them.
inline double middle_of(double below, double above) {
    const double middle = below / 2 + above / 2;
    return middle > below ? middle : above;
}

}  // namespace rrcb
