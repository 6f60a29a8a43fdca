#pragma once

#include "../support/ranks.hpp"
#include "methods.hpp"
#include "share.hpp"

#include <gtest/gtest.h>

namespace rrcb::hard_test {

/// A test per cloud, which goes by its name.
class HardCloud : public testing::TestWithParam<std::string> {
  protected:
    const Cloud& cloud() const { return find_cloud(GetParam()); }
};

/// What this rank holds of a cloud that is scattered over all of them.
inline Share scattered_share(const Cloud& cloud) {
    const int count = cloud.count(parts_for(test::num_ranks()));
    return share_of(cloud, owners_of(cloud, count, Layout::scattered, test::num_ranks()),
                    test::rank());
}

inline std::string name_of(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

}  // namespace rrcb::hard_test
