#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace mpm {

/// Bytes in the form of VTK's XML: in base 64, after their length in 64 bits.
std::string base64(std::span<const std::byte> bytes);

/// Writes one array of numbers of a VTK file.
template <typename Number>
void write_array(std::ofstream& file, std::string_view type, std::string_view name,
                 std::size_t num_components, std::span<const Number> values) {
    file << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
         << num_components << "\" format=\"binary\">\n"
         << base64(std::as_bytes(values)) << "\n</DataArray>\n";
}

/// Writes the start of a VTK file of a type, up to its contents.
void write_head(std::ofstream& file, std::string_view type);

}  // namespace mpm
