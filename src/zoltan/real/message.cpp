#include "zoltan/real/message.hpp"

#include <zoltan_types.h>

#include <cstdio>
#include <mutex>
#include <new>
#include <set>

namespace rrcb::zoltan {

namespace {

void print(int rank, const char* kind, const char* function, std::string_view text) noexcept {
    std::fprintf(stderr, "[%d] Zoltan %s in %s (RRCB):  %.*s\n", rank, kind, function,
                 static_cast<int>(text.size()), text.data());
}

}  // namespace

void throw_fatal(const std::string& text) {
    throw ZoltanError(ZOLTAN_FATAL, text);
}

void print_error(int rank, const char* function, std::string_view text) noexcept {
    print(rank, "ERROR", function, text);
}

void print_warning(int rank, const char* function, std::string_view text) noexcept {
    print(rank, "WARNING", function, text);
}

void warn_once(int rank, const char* function, std::string_view text) noexcept try {
    static std::mutex mutex;
    static auto& printed = *new std::set<std::string>;
    if (rank != 0) return;
    const std::scoped_lock lock(mutex);
    if (printed.emplace(text).second) print_warning(rank, function, text);
} catch (const std::bad_alloc&) {
    // Without memory only the warning is lost.
}

}  // namespace rrcb::zoltan
