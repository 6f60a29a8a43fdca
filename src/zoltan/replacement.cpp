#include "replacement.hpp"

#include "message.hpp"
#include "parameters.hpp"

#include <cstdlib>

namespace rrcb::zoltan {

namespace {

bool read_environment() {
    const char* value = std::getenv("RRCB_REPLACE");
    if (value == nullptr || *value == '\0') return false;
    if (clean(value) == "RCB") return true;
    print_warning(-1, "RRCB_REPLACE", "only RCB can be replaced; the variable is ignored");
    return false;
}

}  // namespace

thread_local int InsideZoltan::depth_ = 0;

bool replaces_rcb() {
    static const bool replaces = read_environment();
    return replaces;
}

}  // namespace rrcb::zoltan
