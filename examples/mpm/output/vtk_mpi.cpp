#include "output/vtk_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string_view>

namespace mpm {

namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Appends the four base-64 digits of up to three bytes.
void append_group(const std::byte* bytes, std::size_t count, std::string& text) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
        group = group << 8 | (i < count ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
    for (std::size_t i = 0; i < 4; ++i)
        text += i <= count ? digits[group >> (18 - 6 * i) & 63] : '=';
}

/// Encodes bytes for VTK's XML: in base 64, preceded by their number as 64 bits.
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

/// Writes one array of numbers of a VTK file.
template <typename Number>
void write_array(std::ofstream& file, std::string_view type, std::string_view name,
                 std::size_t num_components, std::span<const Number> values) {
    file << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
         << num_components << "\" format=\"binary\">\n"
         << base64(std::as_bytes(values)) << "\n</DataArray>\n";
}

/// Writes the beginning of a VTK file of this type, up to its data.
void write_head(std::ofstream& file, std::string_view type) {
    constexpr bool is_little = std::endian::native == std::endian::little;
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
         << "\" version=\"1.0\" byte_order=\"" << (is_little ? "LittleEndian" : "BigEndian")
         << "\" header_type=\"UInt64\">\n";
}

/// Returns the columns that are written as scalars. Position and velocity are written as vectors.
std::vector<std::string> scalars_of(const Particles& particles) {
    std::vector<std::string> names = particles.column_names();
    std::erase_if(names, [](const std::string& name) {
        return name.size() == 1 || name.starts_with("velocity_");
    });
    return names;
}

/// Returns the columns x, y and z of a vector as rows of three numbers; 0 for a missing column.
std::vector<double> triples(const Particles& particles, const std::string& prefix) {
    std::vector<double> rows(3 * particles.size());
    for (std::size_t a = 0; a < 3; ++a) {
        const std::string name = prefix + "xyz"[a];
        if (!particles.has_column(name)) continue;
        const auto column = particles[name];
        for (std::size_t p = 0; p < column.size(); ++p) rows[3 * p + a] = column[p];
    }
    return rows;
}

void write_cells(std::ofstream& file, const std::string& tag,
                 const std::vector<std::int64_t>& connectivity,
                 const std::vector<std::int64_t>& offsets) {
    file << '<' << tag << ">\n";
    write_array<std::int64_t>(file, "Int64", "connectivity", 1, connectivity);
    write_array<std::int64_t>(file, "Int64", "offsets", 1, offsets);
}

/// Returns the displacements as rows of three numbers.
std::vector<double> displacement_rows(const Simulation& simulation) {
    std::vector<double> rows;
    for (const Vector& displacement : simulation.displacements())
        rows.insert(rows.end(), displacement.begin(), displacement.end());
    return rows;
}

/// Returns the pressure of each point, Pa.
std::vector<double> pressures(const Particles& particles) {
    const auto xx = particles["stress_xx"], yy = particles["stress_yy"],
               zz = particles["stress_zz"];
    std::vector<double> pressure(particles.size());
    for (std::size_t p = 0; p < pressure.size(); ++p) pressure[p] = -(xx[p] + yy[p] + zz[p]) / 3;
    return pressure;
}

bool write_points(const std::string& path, const Simulation& simulation, int rank) {
    const Particles& particles = simulation.particles();
    std::ofstream file(path, std::ios::binary);
    const std::size_t count = particles.size();
    std::vector<std::int64_t> numbers(count), offsets(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    std::iota(offsets.begin(), offsets.end(), 1);
    write_head(file, "PolyData");
    file << "<PolyData><Piece NumberOfPoints=\"" << count << "\" NumberOfVerts=\"" << count
         << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n";
    for (const std::string& name : scalars_of(particles))
        write_array<double>(file, "Float64", name, 1, particles[name]);
    write_array<double>(file, "Float64", "pressure", 1, pressures(particles));
    write_array<double>(file, "Float64", "velocity", 3, triples(particles, "velocity_"));
    write_array<double>(file, "Float64", "displacement", 3, displacement_rows(simulation));
    write_array<std::int32_t>(file, "Int32", "part", 1, std::vector<std::int32_t>(count, rank));
    file << "</PointData>\n<Points>\n";
    write_array<double>(file, "Float64", "position", 3, triples(particles, ""));
    file << "</Points>\n";
    write_cells(file, "Verts", numbers, offsets);
    file << "</Verts></Piece></PolyData></VTKFile>\n";
    return file.good();
}

/// Appends the corners of a box clipped to the grid, in the order of a pixel or voxel of VTK.
void append_corners(const Box& box, const GridShape& grid, int dimension,
                    std::vector<double>& corners) {
    const Vector end = grid.upper();
    for (int corner = 0; corner < 1 << dimension; ++corner)
        for (std::size_t a = 0; a < 3; ++a) {
            const bool is_upper = (corner >> a & 1) != 0;
            const double side = is_upper ? box.upper[a] : box.lower[a];
            corners.push_back(a < static_cast<std::size_t>(dimension)
                                  ? std::clamp(side, grid.lower[a], end[a])
                                  : 0);
        }
}

bool write_boxes(const std::string& path, const Decomposition& decomposition, const GridShape& grid,
                 int dimension) {
    constexpr std::uint8_t pixel = 8, voxel = 11;
    const std::size_t count = decomposition.boxes.size(), num_corners = 1U << dimension;
    std::vector<double> corners;
    for (const Box& box : decomposition.boxes) append_corners(box, grid, dimension, corners);
    std::vector<std::int64_t> numbers(count * num_corners), offsets(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    for (std::size_t i = 0; i < count; ++i)
        offsets[i] = static_cast<std::int64_t>((i + 1) * num_corners);
    std::vector<std::int32_t> parts(count);
    std::iota(parts.begin(), parts.end(), 0);

    std::ofstream file(path, std::ios::binary);
    write_head(file, "UnstructuredGrid");
    file << "<UnstructuredGrid><Piece NumberOfPoints=\"" << numbers.size() << "\" NumberOfCells=\""
         << count << "\">\n<CellData>\n";
    write_array<std::int32_t>(file, "Int32", "part", 1, parts);
    file << "</CellData>\n<Points>\n";
    write_array<double>(file, "Float64", "corner", 3, corners);
    file << "</Points>\n";
    write_cells(file, "Cells", numbers, offsets);
    write_array<std::uint8_t>(file, "UInt8", "types", 1,
                              std::vector<std::uint8_t>(count, dimension == 2 ? pixel : voxel));
    file << "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
    return file.good();
}

std::string padded(std::int64_t step) {
    const std::string number = std::to_string(step);
    return std::string(number.size() < 8 ? 8 - number.size() : 0, '0') + number;
}

}  // namespace

VtkSeries::VtkSeries(std::string folder, const Scene& scene, MPI_Comm comm)
    : folder_(std::move(folder)),
      grid_(scene.grid),
      dimension_(scene.dimension),
      comm_(comm),
      rank_(rank_of(comm)),
      num_ranks_(size_of(comm)) {}

void VtkSeries::write(const Simulation& simulation) {
    frames_.push_back({simulation.time(), padded(simulation.step_count())});
    const std::string& number = frames_.back().second;
    const std::string piece = number + '_' + std::to_string(rank_);
    int good = write_points(folder_ + "/points_" + piece + ".vtp", simulation, rank_);
    if (rank_ == 0) {
        good &= write_boxes(folder_ + "/boxes_" + number + "_0.vtu", simulation.decomposition(),
                            grid_, dimension_);
        good &= write_series("points", ".vtp", num_ranks_) && write_series("boxes", ".vtu", 1);
    }
    MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, comm_);
    if (good == 0) throw std::runtime_error(folder_ + ": a VTK file cannot be written there");
}

bool VtkSeries::write_series(const std::string& name, const std::string& extension,
                             int num_pieces) const {
    std::ofstream file(folder_ + "/" + name + ".pvd");
    write_head(file, "Collection");
    file << "<Collection>\n";
    for (const auto& [time, number] : frames_)
        for (int piece = 0; piece < num_pieces; ++piece)
            file << "<DataSet timestep=\"" << time << "\" part=\"" << piece << "\" file=\"" << name
                 << '_' << number << '_' << piece << extension << "\"/>\n";
    file << "</Collection></VTKFile>\n";
    return file.good();
}

}  // namespace mpm
