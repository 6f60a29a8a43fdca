#pragma once

namespace rrcb {

/// Returns the least number in [first, last] for which `holds` is true; last + 1 if there is none.
/// If `holds` is true for a number, it must also be true for all larger ones.
template <class Holds>
int least_number(int first, int last, Holds&& holds) {
    int end = last + 1;
    // Invariant: `holds` is false for all numbers below `first`, and true from `end` on.
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
