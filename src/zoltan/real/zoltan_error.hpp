#pragma once

#include <stdexcept>
#include <string>

namespace rrcb::zoltan {

/// An error of one rank, on its way to becoming a Zoltan return code.
class ZoltanError : public std::runtime_error {
  public:
    ZoltanError(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
    int code() const noexcept { return code_; }

  private:
    int code_;
};

}  // namespace rrcb::zoltan
