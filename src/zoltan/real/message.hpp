#pragma once

#include <string_view>

namespace rrcb::zoltan {

/// Prints a line on stderr in the form of Zoltan's own messages. An unknown rank is -1.
void print_error(int rank, const char* function, std::string_view text) noexcept;
void print_warning(int rank, const char* function, std::string_view text) noexcept;

}  // namespace rrcb::zoltan
