#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace rrcb {

/// Appends a value to the doubles of a message.
template <class Value>
void append(const Value& value, std::vector<double>& doubles) {
    static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % sizeof(double) == 0);
    const std::size_t size = doubles.size();
    doubles.resize(size + sizeof(Value) / sizeof(double));
    std::memcpy(&doubles[size], &value, sizeof value);
}

/// Returns the value at the beginning of doubles.
template <class Value>
Value read(std::span<const double> doubles) {
    Value value;
    std::memcpy(static_cast<void*>(&value), doubles.data(), sizeof value);
    return value;
}

}  // namespace rrcb
