#include "zoltan/entry/fortran.hpp"

#include "zoltan/entry/export.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <atomic>

namespace rrcb::zoltan {

namespace {

std::atomic<bool> registered = false;

}  // namespace

bool is_fortran_used() noexcept {
    return registered;
}

}  // namespace rrcb::zoltan

// Declared in no public header: what Zoltan's Fortran interface calls when it is initialised.
RRCB_EXPORT void Zoltan_Register_Fort_Malloc(void (*allocate)(), void (*free)(),
                                             void (*set_struct)()) {
    const rrcb::zoltan::RealZoltan* real = rrcb::zoltan::real_zoltan();
    if (real == nullptr || real->register_fort_malloc == nullptr) return;
    real->register_fort_malloc(allocate, free, set_struct);
    rrcb::zoltan::registered = real->special_malloc != nullptr && real->special_free != nullptr;
}
