#include "hard_clouds.hpp"

namespace rrcb::hard_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Distributions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_distribution())), name_of);

}  // namespace
}  // namespace rrcb::hard_test
