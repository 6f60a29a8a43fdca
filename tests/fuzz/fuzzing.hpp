#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>

/// Called with every input; returns 0. What goes wrong ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace rrcb::fuzz {

/// Ends the process unless `holds`.
inline void expect(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "not so: %s\n", what);
    std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return size == 0 ? std::string_view()
                     : std::string_view(reinterpret_cast<const char*>(data), size);
}

/// Takes values off the front of an input; zeros behind its end.
class Input {
  public:
    Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    template <class T>
    T take() {
        T value{};
        const std::size_t size = std::min(left_.size(), sizeof value);
        if (size > 0) std::memcpy(&value, left_.data(), size);
        left_ = left_.subspan(size);
        return value;
    }

    int take_below(int end) { return take<std::uint8_t>() % end; }
    std::size_t size() const { return left_.size(); }

  private:
    std::span<const std::uint8_t> left_;
};

}  // namespace rrcb::fuzz
