#include "hard_clouds.hpp"

namespace rrcb::hard_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Positions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_position())), name_of);

}  // namespace
}  // namespace rrcb::hard_test
