#include "callbacks_mpi.hpp"
#include "hard_clouds.hpp"

namespace rrcb::hard_test {
namespace {

TEST_P(HardCloud, is_divided_through_callbacks) {
    check_callbacks(cloud());
}

}  // namespace
}  // namespace rrcb::hard_test
