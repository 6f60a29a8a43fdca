#include "output/vtk_text.hpp"

#include <bit>
#include <cstring>
#include <vector>

namespace mpm {

namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Appends the four digits of up to three bytes.
void append_group(const std::byte* bytes, std::size_t count, std::string& text) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
        group = group << 8 | (i < count ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
    for (std::size_t i = 0; i < 4; ++i)
        text += i <= count ? digits[group >> (18 - 6 * i) & 63] : '=';
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
    const std::uint64_t length = bytes.size();
    std::vector<std::byte> all(sizeof length + bytes.size());
    std::memcpy(all.data(), &length, sizeof length);
    if (!bytes.empty()) std::memcpy(all.data() + sizeof length, bytes.data(), bytes.size());
    std::string text;
    text.reserve(all.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < all.size(); i += 3)
        append_group(all.data() + i, std::min<std::size_t>(3, all.size() - i), text);
    return text;
}

void write_head(std::ofstream& file, std::string_view type) {
    constexpr bool is_little = std::endian::native == std::endian::little;
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
         << "\" version=\"1.0\" byte_order=\"" << (is_little ? "LittleEndian" : "BigEndian")
         << "\" header_type=\"UInt64\">\n";
}

}  // namespace mpm
