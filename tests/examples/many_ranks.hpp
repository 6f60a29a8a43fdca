// Included before an example in C++: more than two ranks make the parts together.
#pragma once

#include <rrcb/rrcb.hpp>

namespace rrcb {

struct OptionsOfManyRanks : Options {
    OptionsOfManyRanks() { expert.max_root_parts = 2; }
};

}  // namespace rrcb

#define Options OptionsOfManyRanks
