#include "zoltan/real/real_zoltan.hpp"

#include "zoltan/real/message.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdio>

namespace rrcb::zoltan {

namespace {

/// Finds functions of the Zoltan behind the plug-in. Notes those that are missing, and those that
/// are in another library than the first.
class Finder {
  public:
    template <typename Function>
    void find(Function& function, const char* name) {
        const Found found(name);
        function = reinterpret_cast<Function>(found.address);
        require(found);
    }

    /// Throws unless Zoltan has a function of this name. Callers look it up by its name later.
    void find(const char* name) { require(Found(name)); }

    /// Finds a function in the library of the functions found so far; null if that has none. A
    /// function of another library could not use the handles.
    template <typename Function>
    void find_beside(Function& function, const char* name) const {
        const Found found(name);
        const bool beside = found.address != nullptr && found.base == first_.base;
        function = beside ? reinterpret_cast<Function>(found.address) : nullptr;
    }

    const char* missing() const { return missing_; }
    bool is_mixed() const { return stray_.address != nullptr; }
    void print_mixture() const {
        std::array<char, 1024> text{};
        std::snprintf(text.data(), text.size(),
                      "%s is from %s, but %s from %s; RRCB needs all of Zoltan from one library, "
                      "and leaves every call to these",
                      first_.name, first_.library, stray_.name, stray_.library);
        print_error(-1, "Zoltan_Create", text.data());
    }

  private:
    struct Found {
        Found() = default;
        explicit Found(const char* its_name) : name(its_name), address(dlsym(RTLD_NEXT, its_name)) {
            Dl_info info{};
            if (address == nullptr || dladdr(address, &info) == 0) return;
            base = info.dli_fbase;
            library = info.dli_fname;
        }
        const char* name = "";
        void* address = nullptr;
        const void* base = nullptr;
        const char* library = "";
    };

    void require(const Found& found) {
        if (found.address == nullptr) {
            missing_ = found.name;
        } else if (first_.address == nullptr) {
            first_ = found;
        } else if (found.base != first_.base) {
            stray_ = found;
        }
    }

    Found first_, stray_;
    const char* missing_ = nullptr;
};

Finder find_all(RealZoltan& real) {
    Finder finder;
#define RRCB_FORWARDED(function, member) finder.find(real.member, #function);
#define RRCB_OPTIONAL(function, member) finder.find_beside(real.member, #function);
#include "zoltan/real/functions.inc"
    for (const char* name :
         {"Zoltan_Malloc", "Zoltan_Realloc", "Zoltan_Free", "Zoltan_Get_Fn", "Zoltan_Migrate"})
        finder.find(name);
    finder.find_beside(real.special_malloc, "Zoltan_Special_Malloc");
    finder.find_beside(real.special_free, "Zoltan_Special_Free");
    return finder;
}

/// Returns the number of bytes of an id entry. Libraries without a function for this have ids of
/// one width only.
std::size_t ask_id_bytes(const Finder& finder) {
    decltype(&Zoltan_get_global_id_type) ask = nullptr;
    finder.find_beside(ask, "Zoltan_get_global_id_type");
    return ask == nullptr ? sizeof(unsigned) : static_cast<std::size_t>(ask(nullptr));
}

const RealZoltan* find_real() {
    static RealZoltan real;
    const Finder finder = find_all(real);
    if (finder.missing() != nullptr) {
        print_error(-1, finder.missing(),
                    "the real function is not found; load or link libtrilinos_zoltan behind "
                    "librrcb_zoltan");
        return nullptr;
    }
    real.words_per_id_entry = ask_id_bytes(finder) / sizeof(std::uint32_t);
    real.serves_rrcb = !finder.is_mixed();
    if (finder.is_mixed()) finder.print_mixture();
    return &real;
}

}  // namespace

const RealZoltan* real_zoltan() noexcept {
    static const RealZoltan* const real = find_real();
    return real;
}

}  // namespace rrcb::zoltan
