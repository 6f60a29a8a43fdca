#include "parallel/communicator_mpi.hpp"
#include "parallel/points.hpp"
#include "step/stepper.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <stdexcept>

namespace mpm {

namespace {

constexpr const char* first_line = "mpm state 4";

void write(std::ostream& file, const std::vector<double>& values) {
    const auto count = static_cast<std::int64_t>(values.size());
    file.write(reinterpret_cast<const char*>(&count), sizeof count);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(double)));
}

std::vector<double> read(std::istream& file) {
    // Reads in parts, so that a file with a wrong length does not make this allocate more memory
    // than the file has bytes.
    std::int64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), sizeof count);
    const auto here = file.tellg();
    file.seekg(0, std::ios::end);
    const auto left = file.tellg() - here;
    file.seekg(here);
    if (!file || count < 0 || count > left / static_cast<std::streamoff>(sizeof(double)))
        throw std::runtime_error("ends too early");
    std::vector<double> values(static_cast<std::size_t>(count));
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

template <typename Numbers>
void append(const Numbers& numbers, std::vector<double>& list) {
    for (const auto number : numbers) list.push_back(static_cast<double>(number));
}

std::vector<Box> boxes_of(std::span<const double> numbers) {
    std::vector<Box> boxes(numbers.size() / 6);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        std::ranges::copy(numbers.subspan(6 * k, 3), boxes[k].lower.begin());
        std::ranges::copy(numbers.subspan(6 * k + 3, 3), boxes[k].upper.begin());
    }
    return boxes;
}

}  // namespace

/// Returns a text of the properties that a scene must share with a state: columns, grid and points.
template <int D>
std::string Stepper<D>::state_names() const {
    std::string names = first_line;
    for (const std::string& column : particles.column_names()) names += ' ' + column;
    return names;
}

template <int D>
std::vector<double> Stepper<D>::state_scene() const {
    std::vector<double> scene{D, scene_.grid.spacing, static_cast<double>(num_points),
                              fingerprint_};
    append(scene_.grid.lower, scene);
    append(scene_.grid.num_cells, scene);
    return scene;
}

/// Returns the time, the speeds and the numbers of effects, which are the same on all ranks.
template <int D>
std::vector<double> Stepper<D>::state_numbers(double speed) const {
    std::vector<double> numbers{time, time_step, max_speed, speed, static_cast<double>(num_steps)};
    for (const double* number : stages_.kept) numbers.push_back(*number);
    return numbers;
}

/// Returns the number of runs after the last sort, and this rank's points.
template <int D>
std::vector<double> Stepper<D>::state_section() const {
    std::vector<double> section{static_cast<double>(num_sorted_runs_)};
    const std::size_t begin = section.size(), width = particles.column_names().size();
    section.resize(begin + particles.size() * width);
    for (std::size_t p = 0; p < particles.size(); ++p)
        particles.copy_row(p, std::span(section).subspan(begin + p * width, width));
    return section;
}

template <int D>
void Stepper<D>::write_state(const std::string& path) const {
    std::vector<double> boxes;
    for (const Box& box : decomposition.boxes) {
        append(box.lower, boxes);
        append(box.upper, boxes);
    }
    const double speed = speed_of_all(speed_);
    bool is_good = true;
    // The ranks write one after another.
    for (int rank = 0; rank < size_of(comm_); ++rank) {
        MPI_Barrier(comm_);
        if (rank != rank_of(comm_)) continue;
        std::ofstream file(path, rank == 0 ? std::ios::binary : std::ios::binary | std::ios::app);
        if (rank == 0) {
            file << state_names() << '\n';
            for (const auto& part : {state_scene(), state_numbers(speed), boxes}) write(file, part);
        }
        write(file, state_section());
        is_good = static_cast<bool>(file.flush());
    }
    fail_together(is_good ? "" : path + ": cannot be written", comm_);
}

/// Appends the points of a section that this rank owns.
template <int D>
void Stepper<D>::append_own(std::span<const double> rows) {
    const std::size_t width = particles.column_names().size();
    for (std::size_t at = 0; at + width <= rows.size(); at += width) {
        const std::span<const double> row = rows.subspan(at, width);
        Vector place{};
        for (std::size_t a = 0; a < D; ++a) place[a] = row[motion_.position[a]];
        int owner = 0;
        decomposition.owners({{&place[0], 1}, {&place[1], 1}, {&place[2], D == 3 ? 1U : 0U}},
                             {&owner, 1});
        if (owner == rank_of(comm_)) particles.append(row);
    }
}

/// Reads a state without communication. If the number of ranks is that of the file, each rank reads
/// its own section.
template <int D>
void Stepper<D>::load_state(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string names;
    std::getline(file, names);
    if (!file || !names.starts_with(first_line))
        throw std::runtime_error("is no state that this program wrote");
    const std::vector<double> scene = read(file), numbers = read(file), own = state_numbers(0);
    if (names != state_names() || scene != state_scene() || numbers.size() != own.size())
        throw std::runtime_error(
            "is the state of another scene, of another grid, or of other bodies, materials, "
            "effects or method");
    const std::vector<Box> boxes = boxes_of(read(file));
    const bool has_own = boxes.size() == static_cast<std::size_t>(size_of(comm_));
    if (has_own) divide_by(within(boxes));
    std::vector<std::size_t> all(particles.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    particles.remove(all);
    for (std::size_t rank = 0; rank < boxes.size(); ++rank) {
        const std::vector<double> section = read(file);
        if (section.empty()) throw std::runtime_error("ends too early");
        const auto rows = std::span(section).subspan(1);
        if (!has_own) append_own(rows);
        if (!has_own || rank != static_cast<std::size_t>(rank_of(comm_))) continue;
        num_sorted_runs_ = static_cast<std::size_t>(section[0]);
        particles.append(rows);
    }
    fit_patch();
    if (!has_own) sort();
    time = numbers[0];
    time_step = numbers[1];
    max_speed = numbers[2];
    start_speed_ = speed_ = numbers[3];
    num_steps = static_cast<std::int64_t>(numbers[4]);
    for (std::size_t k = 0; k < stages_.kept.size(); ++k) *stages_.kept[k] = numbers[5 + k];
}

template <int D>
void Stepper<D>::read_state(const std::string& path) {
    std::string error;
    try {
        load_state(path);
    } catch (const std::exception& fault) {
        error = path + ": " + fault.what();
    }
    fail_together(error, comm_);
    neighbours_.emplace(boxes_of(decomposition), D, comm_, travel_);
}

template void Stepper<2>::write_state(const std::string&) const;
template void Stepper<3>::write_state(const std::string&) const;
template void Stepper<2>::read_state(const std::string&);
template void Stepper<3>::read_state(const std::string&);

}  // namespace mpm
