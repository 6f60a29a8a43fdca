#include "zoltan/real/message.hpp"

#include <zoltan_types.h>

#include <cstdio>

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

}  // namespace rrcb::zoltan
