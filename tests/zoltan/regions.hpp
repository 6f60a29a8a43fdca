#pragma once

#include "program.hpp"

#include <cfloat>

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

/// Expects look-ups of an object to find one part and rank, by its point, box and region.
inline void expect_found(const Program& program, std::size_t object, int part, int rank) {
    const double* x = &program.coordinates[object * static_cast<std::size_t>(program.dimension)];
    ASSERT_EQ(program.place_of(x), (Place{ZOLTAN_OK, rank, part}));
    std::vector<int> ranks(static_cast<std::size_t>(program.num_ranks)), parts(ranks);
    int num_ranks = 0, num_parts = 0;
    ASSERT_EQ(Zoltan_LB_Box_PP_Assign(program.zz, x[0], x[1], 0, x[0], x[1], 0, ranks.data(),
                                      &num_ranks, parts.data(), &num_parts),
              ZOLTAN_OK);
    ASSERT_TRUE(num_parts == 1 && parts[0] == part && num_ranks == 1 && ranks[0] == rank);
    const Region region = region_of(program.zz, part);
    ASSERT_EQ(region.code, ZOLTAN_OK);
    for (std::size_t a = 0; a < 2; ++a)
        ASSERT_TRUE(region.lower[a] <= x[a] && x[a] <= region.upper[a]);
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
