#include "zoltan/real/real_zoltan.hpp"

namespace rrcb::zoltan {

const RealZoltan* real_zoltan() noexcept {
    static const RealZoltan real{
#define RRCB_FORWARDED(function, member) .member = (function),
#include "zoltan/real/functions.inc"
        .words_per_id_entry =
            static_cast<std::size_t>(Zoltan_get_global_id_type(nullptr)) / sizeof(std::uint32_t),
    };
    return &real;
}

}  // namespace rrcb::zoltan
