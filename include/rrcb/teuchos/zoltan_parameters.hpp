#pragma once

#include <rrcb/teuchos/parameters.hpp>

#include <zoltan.h>

namespace rrcb::teuchos {

/// Sets the parameters of a list on a handle of the plug-in. LB_METHOD is not changed. Not
/// collective.
///
/// @param handle created by the plug-in
/// @param list   as for options_from
/// @return ZOLTAN_OK, or the first other code of Zoltan_Set_Param, after which nothing more is set;
/// ZOLTAN_WARN if the plug-in is not in front of Zoltan
/// Throws Error as options_from does, before anything is set.
inline int set_parameters(Zoltan_Struct* handle, const Teuchos::ParameterList& list) {
    for (const auto& [name, value] : zoltan_strings(list)) {
        const int code = Zoltan_Set_Param(handle, name.c_str(), value.c_str());
        if (code != ZOLTAN_OK) return code;
    }
    return ZOLTAN_OK;
}

}  // namespace rrcb::teuchos
