#include "c/sized.hpp"

#include "options/rejection.hpp"

#include <rrcb/version.hpp>

#include <cctype>
#include <string>

namespace rrcb::c {

namespace {

/// No struct is ever larger. A larger size means that it was never set.
constexpr std::size_t largest_size = 4096;

/// Returns the name of the macro that initialises a struct: RRCB_POINTS_INIT for rrcb_points, whose
/// mangled name is 11rrcb_points.
std::string macro_of(const std::type_info& type) {
    std::string name = type.name();
    name.erase(0, name.find("rrcb_"));
    for (char& letter : name) letter = static_cast<char>(std::toupper(letter));
    return name + "_INIT";
}

}  // namespace

void check_size(const void* given, std::size_t known, const std::type_info& type,
                const char* name) {
    std::size_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size == 0 || size > largest_size || size % sizeof size != 0)
        reject("size of " + std::string(name) + " is not set; initialise it by " + macro_of(type));
    const auto* bytes = static_cast<const std::byte*>(given);
    if (size > known && std::any_of(bytes + known, bytes + size,
                                    [](std::byte each) { return each != std::byte(); }))
        reject(std::string(name) + ", by " + macro_of(type) +
               " of a later version, sets a member that version " + rrcb::version() +
               " lacks; leave it 0, or run with the later library");
}

}  // namespace rrcb::c
