#include "zoltan/entry/entry_point.hpp"
#include "zoltan/handle/parameters.hpp"

#include <rrcb/version.hpp>
#include <rrcb/zoltan/rrcb_zoltan.h>

RRCB_EXPORT const char* RRCB_Version(void) {
    return rrcb::version();
}

RRCB_EXPORT const char* const* RRCB_Parameter_Names(void) {
    static const std::vector<const char*> names = [] {
        std::vector<const char*> list = rrcb::zoltan::own_parameter_names();
        list.push_back(nullptr);
        return list;
    }();
    return names.data();
}
