// Included before an example in C++: more than two ranks make the parts together, and each gets its
// own cuts alone.
#pragma once

#include <rrcb/rrcb.hpp>

namespace rrcb {

struct OptionsOfManyRanks : Options {
    OptionsOfManyRanks() {
        tuning.central_parts = 2;
        cuts = HeldCuts::own;
    }
};

}  // namespace rrcb

#define Options OptionsOfManyRanks
