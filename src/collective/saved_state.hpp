#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace rrcb {

/// Contents of a saved state.
enum class StateKind : std::uint64_t {
    cuts = 1,
    controller = 2,
    cost_model = 3,
    zoltan_handle = 4
};

/// Saved state as words of 8 bytes. The same calls write and read it.
///
/// A head contains the format, the kind, the number of words and a checksum. When bytes from a
/// machine with the other byte order are read, each word is reversed.
class SavedState {
  public:
    /// Starts writing a state.
    explicit SavedState(StateKind kind);
    /// Starts reading a state. Throws Error if the bytes are not a complete state of this kind.
    SavedState(std::span<const std::byte> bytes, StateKind kind);

    /// Writes or reads each value.
    template <class... Values>
    void each(Values&... values) {
        (one(values), ...);
    }

    /// Writes or reads a count. Throws Error if a count above `most` is read.
    template <class Count>
    void count(Count& value, std::size_t most) {
        one(value);
        require_count(static_cast<std::uint64_t>(value), most);
    }

    /// Returns whether the state has the words that a format has added: 1 is that of version 0.2,
    /// and 2 adds the numbers that the steps of a controller hand on.
    bool has_format(std::uint64_t number) const;

    /// Returns the number of words still to be read. When writing, returns SIZE_MAX.
    std::size_t num_left() const { return reads_ ? words_.size() - next_ : SIZE_MAX; }

    std::vector<std::byte> bytes();

  private:
    template <class Value>
    void one(Value& value) {
        if constexpr (std::is_same_v<Value, double>) {
            std::uint64_t word = std::bit_cast<std::uint64_t>(value);
            exchange(word);
            value = std::bit_cast<double>(word);
        } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
            auto word = static_cast<std::uint64_t>(value);
            exchange(word);
            value = static_cast<Value>(word);
        } else if constexpr (requires { value.store(*this); }) {
            value.store(*this);
        } else {
            for (auto& element : value) one(element);
        }
    }

    void exchange(std::uint64_t& word);
    static void require_count(std::uint64_t value, std::size_t most);

    std::vector<std::uint64_t> words_;
    std::size_t next_;
    bool reads_;
};

}  // namespace rrcb
