#pragma once

#include "cloud.hpp"

#include <gtest/gtest.h>

namespace rrcb::hard_test {

/// A test per cloud, which goes by its name.
class HardCloud : public testing::TestWithParam<std::string> {
  protected:
    const Cloud& cloud() const { return find_cloud(GetParam()); }
};

inline std::string name_of(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

}  // namespace rrcb::hard_test
