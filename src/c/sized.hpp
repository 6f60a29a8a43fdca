#pragma once

#include "c/balancer.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

// These functions read and write structs of C programs, which may have been compiled with fewer or
// more members than the library has. Each struct begins with its size in the program, beyond which
// nothing is read or written.

namespace rrcb::c {

/// Throws Error unless the size of a struct is set and all its bytes after the `known` ones are 0.
/// `type` is the type of the struct, `name` the name of the argument.
void check_size(const void* given, std::size_t known, const std::type_info& type, const char* name);

/// Throws Error if a struct is null, or in the cases of check_size().
template <class Struct>
void require_sized(const Struct* given, const char* name) {
    static_assert(offsetof(Struct, size) == 0 && std::is_trivially_copyable_v<Struct>);
    require(given, name);
    check_size(given, sizeof(Struct), typeid(Struct), name);
}

/// Returns a copy of a struct. Members that the program does not have are 0. Throws Error as
/// require_sized().
template <class Struct>
Struct copy_in(const Struct* given, const char* name) {
    require_sized(given, name);
    Struct copy{};
    std::memcpy(&copy, given, std::min(given->size, sizeof copy));
    return copy;
}

/// Returns copies of the structs in an array. All have the size of the first.
template <class Struct>
std::vector<Struct> copy_all_in(const Struct* given, std::size_t count, const char* name) {
    require_array(count, given, name);
    std::vector<Struct> copies;
    for (std::size_t k = 0; k < count; ++k) {
        const auto* bytes = reinterpret_cast<const std::byte*>(given) + k * given->size;
        copies.push_back(copy_in(reinterpret_cast<const Struct*>(bytes), name));
        if (copies.back().size != given->size)
            reject(std::string(name) + " must all be initialised by one macro: their sizes differ");
    }
    return copies;
}

/// Writes a struct to the program's, which must have passed require_sized(). Its size is left
/// unchanged.
template <class Struct>
void copy_out(const std::type_identity_t<Struct>& made, Struct* place) {
    const std::size_t size = std::min(place->size, sizeof made);
    std::memcpy(reinterpret_cast<std::byte*>(place) + sizeof size,
                reinterpret_cast<const std::byte*>(&made) + sizeof size, size - sizeof size);
}

}  // namespace rrcb::c
