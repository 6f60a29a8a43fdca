#include "hard_clouds.hpp"
#include "interface_mpi.hpp"

namespace rrcb::hard_test {
namespace {

TEST_P(HardCloud, is_divided_by_the_interface) {
    check_interface(cloud());
}

}  // namespace
}  // namespace rrcb::hard_test
