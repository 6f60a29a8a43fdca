#pragma once

#include "program.hpp"

#include <array>
#include <cfloat>
#include <set>

namespace rrcb::zoltan_test {

struct Region {
    int code = 0, dimension = 0;
    std::array<double, 3> lower{}, upper{};
};

inline Region region_of(Zoltan_Struct* zz, int part) {
    Region region;
    auto& lo = region.lower;
    auto& hi = region.upper;
    region.code =
        Zoltan_RCB_Box(zz, part, &region.dimension, &lo[0], &lo[1], &lo[2], &hi[0], &hi[1], &hi[2]);
    return region;
}

/// How many different planes the parts have across each axis.
inline std::array<int, 3> planes_per_axis(const Program& program, int num_parts) {
    std::array<std::set<double>, 3> planes;
    for (int part = 0; part < num_parts; ++part) {
        const Region region = region_of(program.zz, part);
        for (std::size_t a = 0; a < 3; ++a) {
            if (region.lower[a] > -DBL_MAX) planes[a].insert(region.lower[a]);
            if (region.upper[a] < DBL_MAX) planes[a].insert(region.upper[a]);
        }
    }
    return {int(planes[0].size()), int(planes[1].size()), int(planes[2].size())};
}

}  // namespace rrcb::zoltan_test
