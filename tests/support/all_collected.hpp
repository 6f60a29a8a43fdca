// All points of a rank as a search takes them.
#pragma once

#include "passes/collected.hpp"
#include "search/collected_tree.hpp"

namespace rrcb::test {

inline OpenPoints all_collected(const Points& points) {
    OpenPoints collected;
    collect_all(points, collected);
    return collected;
}

}  // namespace rrcb::test
