#pragma once

#include <zoltan.h>

namespace rrcb::zoltan {

/// A registered callback with the data pointer it wants; false when there is none.
template <typename Function>
struct Callback {
    Function* function = nullptr;
    void* data = nullptr;

    explicit operator bool() const { return function != nullptr; }

    template <typename... Arguments>
    auto operator()(Arguments... arguments) const {
        return function(data, arguments...);
    }
};

template <typename Function>
Callback<Function> callback(Zoltan_Struct* zz, ZOLTAN_FN_TYPE type) {
    ZOLTAN_VOID_FN* function = nullptr;
    void* data = nullptr;
    if (Zoltan_Get_Fn(zz, type, &function, &data) != ZOLTAN_OK) return {};
    return {reinterpret_cast<Function*>(function), data};
}

}  // namespace rrcb::zoltan
