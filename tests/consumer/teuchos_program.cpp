// A header for Teuchos, and the library behind it.
#include <rrcb/teuchos/parameters.hpp>

int main() {
    Teuchos::ParameterList list;
    list.set("RRCB_SUPPORT_MESH", 6);
    const rrcb::Options options = rrcb::teuchos::options_from(list);
    return options.expert.cells_per_axis == 6 ? 0 : 1;
}
