#include "zoltan/call/fortran_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <array>
#include <atomic>
#include <cstring>
#include <new>
#include <utility>

namespace rrcb::zoltan {

namespace {

std::atomic<bool> registered = false;

/// Kind of an array, as numbered by Zoltan_Special_Malloc.
enum class Kind : int { integers, global_ids, local_ids };

/// Arrays stored in the caller's variables. The destructor frees them unless stay() was called.
class FortranArrays {
  public:
    explicit FortranArrays(Zoltan_Struct* zz) : zz_(zz) {}
    FortranArrays(const FortranArrays&) = delete;
    FortranArrays& operator=(const FortranArrays&) = delete;
    ~FortranArrays() {
        for (int i = 0; i < num_given_; ++i) {
            const auto [array, kind] = given_[i];
            real_zoltan()->special_free(zz_, array, static_cast<int>(kind));
            *array = nullptr;
        }
    }

    void copy(const List& list, const IdWidths& widths, const CallerList& to) {
        if (list.count <= 0) return;
        copy(list.global_ids, list.count, widths.global, Kind::global_ids, to.global_ids);
        copy(list.local_ids, list.count, widths.local, Kind::local_ids, to.local_ids);
        copy(list.ranks, list.count, 1, Kind::integers, to.ranks);
        if (to.parts != nullptr) copy(list.parts, list.count, 1, Kind::integers, to.parts);
    }

    void stay() noexcept { num_given_ = 0; }

  private:
    template <typename T, typename Pointer>
    void copy(const ZoltanArray<T>& from, int count, std::size_t width, Kind kind, Pointer* to) {
        auto* const array = reinterpret_cast<void**>(to);
        if (real_zoltan()->special_malloc(zz_, array, count, static_cast<int>(kind)) == 0)
            throw std::bad_alloc();
        given_[num_given_++] = {array, kind};
        if (from) std::memcpy(*array, from.get(), count * width * sizeof(T));
    }

    Zoltan_Struct* zz_;
    std::array<std::pair<void**, Kind>, 8> given_;  ///< arrays of both lists
    int num_given_ = 0;
};

}  // namespace

void register_fortran(FortranFunction allocate, FortranFunction free, FortranFunction set_struct) {
    const RealZoltan* real = real_zoltan();
    if (real == nullptr || real->register_fort_malloc == nullptr) return;
    real->register_fort_malloc(allocate, free, set_struct);
    registered = real->special_malloc != nullptr && real->special_free != nullptr;
}

bool is_fortran_used() noexcept {
    return registered;
}

void copy_for_fortran(Zoltan_Struct* zz, const Lists& lists, const IdWidths& widths,
                      const CallerLists& to, Participant& self) {
    FortranArrays copies(zz);
    self.attempt([&] {
        copies.copy(lists.imports, widths, to.imports);
        copies.copy(lists.exports, widths, to.exports);
    });
    // If a rank has no memory, all ranks return no lists; the Error then frees the arrays made
    // here.
    agree(self);
    copies.stay();
}

}  // namespace rrcb::zoltan
