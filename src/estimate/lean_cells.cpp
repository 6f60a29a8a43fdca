#include "estimate/cell_records.hpp"

#include <rrcb/detail/support_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace rrcb {

namespace {

constexpr double steps = 255;

std::byte code_of(double share) {
    return static_cast<std::byte>(static_cast<int>(std::clamp(share, 0.0, 1.0) * steps + 0.5));
}

double share_of(std::byte code) {
    return std::to_integer<int>(code) / steps;
}

/// Returns the code of a mean. Computes with half extents, which do not overflow for any
/// coordinates.
std::byte code_of_mean(double mean, double lower, double upper) {
    const double half = upper / 2 - lower / 2;
    return half > 0 ? code_of((mean / 2 - lower / 2) / half) : std::byte{0};
}

/// Codes from here on are proportional to the square root of a deviation, smaller codes to its
/// logarithm.
constexpr int first_root = 64;
constexpr double logarithm_step = 0.6;  // of the logarithm to base 2

double share_of_deviation(int code) {
    constexpr double steps_below = first_root / steps;
    if (code >= first_root) return (code / steps) * (code / steps);
    if (code == 0) return 0;
    return steps_below * steps_below * std::exp2((code - first_root) * logarithm_step);
}

std::byte code_of_deviation(double deviation, double lower, double upper) {
    const double half = upper / 2 - lower / 2;
    if (!(half > 0 && deviation > 0)) return std::byte{0};
    const double share = std::min(1.0, deviation / half);
    const std::byte root = code_of(std::sqrt(share));
    if (root >= std::byte{first_root}) return root;
    const double steps_down = std::log2(share / share_of_deviation(first_root)) / logarithm_step;
    return static_cast<std::byte>(
        static_cast<int>(std::max(1.0, std::round(first_root + steps_down))));
}

/// Returns the mean of a cell. A mean on a face, with a deviation above 0, is moved inwards to the
/// mean of a uniform density that touches the face.
double mean_of(std::byte code, double deviation, double lower, double upper) {
    const double share = share_of(code);
    if (share > 0 && share < 1) return std::lerp(lower, upper, share);
    const double half = upper / 2 - lower / 2;
    const double inside = std::min(std::sqrt(3.0) * deviation, half / (2 * steps));
    return share > 0 ? upper - inside : lower + inside;
}

/// Appends a number with seven bits in each byte. The upper bit is set in all bytes except the
/// last.
void append_number(std::size_t number, std::vector<std::byte>& bytes) {
    for (; number >= 128; number /= 128) bytes.push_back(std::byte(number % 128 + 128));
    bytes.push_back(std::byte(number));
}

std::size_t take_number(std::span<const std::byte>& bytes) {
    std::size_t number = 0;
    int shift = 0;
    bool has_more = true;
    while (has_more) {
        const auto digit = std::to_integer<std::size_t>(bytes.front());
        bytes = bytes.subspan(1);
        number += digit % 128 << shift;
        shift += 7;
        has_more = digit >= 128;
    }
    return number;
}

void append_float(float number, std::vector<std::byte>& bytes) {
    const auto of_number = std::as_bytes(std::span(&number, 1));
    bytes.insert(bytes.end(), of_number.begin(), of_number.end());
}

float take_float(std::span<const std::byte>& bytes) {
    float number;
    std::memcpy(&number, bytes.data(), sizeof number);
    bytes = bytes.subspan(sizeof number);
    return number;
}

/// Returns a weight in units of 2^exponent.
float lean_weight(double weight, int exponent) {
    const auto lean = static_cast<float>(std::ldexp(weight, -exponent));
    return weight > 0 ? std::max(lean, std::numeric_limits<float>::denorm_min()) : 0.0F;
}

int exponent_of(std::span<const CellMoments> cells) {
    double greatest = 0;
    for (const CellMoments& cell : cells) greatest = std::max(greatest, cell.moments.weight);
    return greatest > 0 ? std::ilogb(greatest) : 0;
}

}  // namespace

LeanCells pack_cells(std::span<const CellMoments> cells, const SupportMesh& mesh) {
    LeanCells lean;
    lean.exponent = exponent_of(cells);
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    lean.bytes.reserve(cells.size() * (sizeof(float) + 2 * dimension + 2));
    LocalIndex next = 0;
    for (const CellMoments& cell : cells) {
        const LocalIndex gap = cell.cell - next;
        const float weight = lean_weight(cell.moments.weight, lean.exponent);
        append_float(gap > 0 ? -weight : weight, lean.bytes);
        if (gap > 0) append_number(gap, lean.bytes);
        next = cell.cell + 1;
        for (std::size_t a = 0; a < dimension; ++a) {
            const auto [lower, upper] = std::pair(cell.box.lower[a], cell.box.upper[a]);
            lean.bytes.push_back(code_of_mean(cell.moments.mean[a], lower, upper));
            lean.bytes.push_back(code_of_deviation(cell.moments.deviation[a], lower, upper));
        }
    }
    return lean;
}

void unpack_cells(int exponent, std::span<const std::byte> packed, std::size_t count,
                  const SupportMesh& mesh, std::vector<CellMoments>& cells) {
    const std::size_t first = cells.size();
    cells.resize(first + count);
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    std::array<double, 256> shares;
    for (int code = 0; code < 256; ++code) shares[code] = share_of_deviation(code);
    LocalIndex next = 0;
    for (CellMoments& cell : std::span(cells).subspan(first)) {
        const float weight = take_float(packed);
        cell.cell = next + (std::signbit(weight) ? take_number(packed) : 0);
        next = cell.cell + 1;
        cell.moments.weight = std::ldexp(static_cast<double>(std::abs(weight)), exponent);
        cell.box = cell_box(mesh, cell.cell);
        for (std::size_t a = 0; a < dimension; ++a) {
            const auto [lower, upper] = std::pair(cell.box.lower[a], cell.box.upper[a]);
            const auto code = std::to_integer<std::size_t>(packed[2 * a + 1]);
            const double deviation = shares[code] * (upper / 2 - lower / 2);
            cell.moments.deviation[a] = deviation;
            cell.moments.mean[a] = mean_of(packed[2 * a], deviation, lower, upper);
        }
        packed = packed.subspan(2 * dimension);
    }
}

}  // namespace rrcb
