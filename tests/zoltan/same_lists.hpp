#pragma once

#include "program.hpp"

#include <gtest/gtest.h>

namespace rrcb::zoltan_test {

/// All that lists say.
inline void expect_same(const ListCopy& a, const ListCopy& b) {
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.global_ids, b.global_ids);
    EXPECT_EQ(a.local_ids, b.local_ids);
    EXPECT_EQ(a.ranks, b.ranks);
    EXPECT_EQ(a.parts, b.parts);
}

inline void expect_same(const Outcome& a, const Outcome& b) {
    EXPECT_EQ(a.code, b.code);
    EXPECT_EQ(a.changes, b.changes);
    EXPECT_EQ(a.num_gid, b.num_gid);
    EXPECT_EQ(a.num_lid, b.num_lid);
    expect_same(a.imports, b.imports);
    expect_same(a.exports, b.exports);
}

}  // namespace rrcb::zoltan_test
