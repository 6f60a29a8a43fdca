#pragma once

namespace rrcb {

/// Returns the least number in [first, last] for which `holds` is true, as for all above it; last +
/// 1 if there is none.
template <class Holds>
int least_number(int first, int last, Holds&& holds) {
    int end = last + 1;
    // False for all below `first`, true from `end` on.
    while (first < end) {
        const int middle = first + (end - first) / 2;
        if (holds(middle)) {
            end = middle;
        } else {
            first = middle + 1;
        }
    }
    return end;
}

}  // namespace rrcb
