#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rrcb::zoltan {

/// An error on one rank, with the code that Zoltan's function returns.
class ZoltanError : public std::runtime_error {
  public:
    ZoltanError(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
    int code() const noexcept { return code_; }

  private:
    int code_;
};

/// Throws a ZoltanError with ZOLTAN_FATAL.
[[noreturn]] void throw_fatal(const std::string& text);

/// Print a line on stderr in the form of Zoltan's own messages. Pass -1 if the rank is unknown.
void print_error(int rank, const char* function, std::string_view text) noexcept;
void print_warning(int rank, const char* function, std::string_view text) noexcept;

/// Prints a warning on rank 0, unless the process has printed it before or has no memory.
void warn_once(int rank, const char* function, std::string_view text) noexcept;

}  // namespace rrcb::zoltan
