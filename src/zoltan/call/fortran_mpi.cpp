#include "zoltan/call/fortran_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <array>
#include <atomic>
#include <cstring>
#include <new>

namespace rrcb::zoltan {

namespace {

std::atomic<bool> registered = false;

/// Kinds of arrays, as Zoltan_Special_Malloc numbers them.
enum class Kind : int { integers, global_ids, local_ids };

/// Arrays of one list in the caller's variables. The destructor frees them unless stay() was
/// called.
class FortranList {
  public:
    FortranList(Zoltan_Struct* zz, const CallerList& to) : zz_(zz), to_(to) {}
    FortranList(const FortranList&) = delete;
    FortranList& operator=(const FortranList&) = delete;
    ~FortranList() {
        for (const Given& given : given_) {
            if (given.array == nullptr) continue;
            real_zoltan()->special_free(zz_, given.array, static_cast<int>(given.kind));
            *given.array = nullptr;
        }
    }

    void copy(const List& list) {
        if (list.count <= 0) return;
        copy(list.global_ids, list.count, Kind::global_ids, to_.global_ids, given_[0]);
        copy(list.local_ids, list.count, Kind::local_ids, to_.local_ids, given_[1]);
        copy(list.ranks, list.count, Kind::integers, to_.ranks, given_[2]);
        if (to_.parts != nullptr)
            copy(list.parts, list.count, Kind::integers, to_.parts, given_[3]);
    }

    void stay() noexcept { given_ = {}; }

  private:
    struct Given {
        void** array = nullptr;
        Kind kind = Kind::integers;
    };

    template <typename T, typename Pointer>
    void copy(const ZoltanArray<T>& from, int count, Kind kind, Pointer* to, Given& given) {
        auto* const array = reinterpret_cast<void**>(to);
        if (real_zoltan()->special_malloc(zz_, array, count, static_cast<int>(kind)) == 0)
            throw std::bad_alloc();
        given = {array, kind};
        if (from.size() > 0) std::memcpy(*array, from.get(), from.size() * sizeof(T));
    }

    Zoltan_Struct* zz_;
    const CallerList& to_;
    std::array<Given, 4> given_;
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

void copy_for_fortran(Zoltan_Struct* zz, const List& imports, const List& exports,
                      const CallerLists& to, Participant& self) {
    FortranList import_copy(zz, to.imports);
    FortranList export_copy(zz, to.exports);
    self.attempt([&] {
        import_copy.copy(imports);
        export_copy.copy(exports);
    });
    // A rank without memory leaves all ranks without lists. The error frees those made here.
    agree(self);
    import_copy.stay();
    export_copy.stay();
}

}  // namespace rrcb::zoltan
