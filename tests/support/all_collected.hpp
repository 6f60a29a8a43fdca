// All points of a rank as a search takes them.
#pragma once

#include "passes/host_passes.hpp"
#include "search/collected_tree.hpp"

namespace rrcb::test {

inline OpenPoints all_collected(const Points& points) {
    OpenPoints collected;
    HostPasses(points).collect_all(collected);
    return collected;
}

}  // namespace rrcb::test
