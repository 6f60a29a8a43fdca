#include "step/state_file_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>
#include <cstring>

namespace mpm {

namespace {

constexpr const char* first_line = "mpm state 1";
constexpr int section_tag = 3;
/// Doubles in a message: MPI counts in int.
constexpr std::size_t most_in_message = std::size_t{1} << 24;

void write(std::ofstream& file, std::span<const double> values) {
    const auto count = static_cast<std::int64_t>(values.size());
    file.write(reinterpret_cast<const char*>(&count), sizeof count);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size_bytes()));
}

std::vector<double> read(std::ifstream& file) {
    // No file that lies about a length makes this take more memory than the file has bytes.
    std::int64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), sizeof count);
    const auto here = file.tellg();
    file.seekg(0, std::ios::end);
    const auto left = file.tellg() - here;
    file.seekg(here);
    if (!file || count < 0 || count > left / static_cast<std::streamoff>(sizeof(double))) {
        file.setstate(std::ios::failbit);
        return {};
    }
    std::vector<double> values(static_cast<std::size_t>(count));
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

std::vector<double> numbers_of(const std::vector<Box>& boxes) {
    std::vector<double> numbers;
    for (const Box& box : boxes) {
        numbers.insert(numbers.end(), box.lower.begin(), box.lower.end());
        numbers.insert(numbers.end(), box.upper.begin(), box.upper.end());
    }
    return numbers;
}

std::vector<Box> boxes_of(std::span<const double> numbers) {
    std::vector<Box> boxes(numbers.size() / 6);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        std::ranges::copy(numbers.subspan(6 * k, 3), boxes[k].lower.begin());
        std::ranges::copy(numbers.subspan(6 * k + 3, 3), boxes[k].upper.begin());
    }
    return boxes;
}

template <typename Transfer>
void in_messages(std::size_t count, Transfer transfer) {
    for (std::size_t at = 0; at < count; at += most_in_message)
        transfer(at, static_cast<int>(std::min(most_in_message, count - at)));
}

void send(const std::vector<double>& values, MPI_Comm comm) {
    const auto count = static_cast<std::uint64_t>(values.size());
    MPI_Send(&count, 1, MPI_UINT64_T, 0, section_tag, comm);
    in_messages(values.size(), [&](std::size_t at, int length) {
        MPI_Send(values.data() + at, length, MPI_DOUBLE, 0, section_tag, comm);
    });
}

std::vector<double> receive(int rank, MPI_Comm comm) {
    std::uint64_t count = 0;
    MPI_Recv(&count, 1, MPI_UINT64_T, rank, section_tag, comm, MPI_STATUS_IGNORE);
    std::vector<double> values(count);
    in_messages(values.size(), [&](std::size_t at, int length) {
        MPI_Recv(values.data() + at, length, MPI_DOUBLE, rank, section_tag, comm,
                 MPI_STATUS_IGNORE);
    });
    return values;
}

void write_head(std::ofstream& file, const StateHead& head) {
    file << first_line << '\n';
    for (const std::string& column : head.columns) file << column << ' ';
    file << '\n';
    for (const auto* part : {&head.scene, &head.numbers, &head.effects}) write(file, *part);
    write(file, numbers_of(head.boxes));
}

}  // namespace

void write_state_file(const std::string& path, const StateHead& head,
                      const std::vector<double>& section, MPI_Comm comm) {
    std::string error;
    if (rank_of(comm) != 0) {
        send(section, comm);
    } else {
        std::ofstream file(path, std::ios::binary);
        write_head(file, head);
        write(file, section);
        for (int rank = 1; rank < size_of(comm); ++rank) write(file, receive(rank, comm));
        if (!file.flush()) error = path + ": cannot be written";
    }
    fail_together(error, comm);
}

StateReader::StateReader(const std::string& path, MPI_Comm comm) : path_(path), comm_(comm) {
    std::string error, line, columns;
    if (rank_of(comm) == 0) {
        file_.open(path, std::ios::binary);
        std::getline(file_, line);
        std::getline(file_, columns);
        if (!file_ || line != first_line) error = path + ": is no state that this program wrote";
    }
    fail_together(error, comm);
    columns = broadcast(columns, comm);
    for (std::size_t at = 0, end = 0; (end = columns.find(' ', at)) != std::string::npos;
         at = end + 1)
        head_.columns.push_back(columns.substr(at, end - at));
    const auto next = [&] {
        return shared(rank_of(comm) == 0 ? read(file_) : std::vector<double>{});
    };
    head_.scene = next();
    head_.numbers = next();
    head_.effects = next();
    head_.boxes = boxes_of(next());
}

std::vector<double> StateReader::next_section() {
    return shared(rank_of(comm_) == 0 ? read(file_) : std::vector<double>{});
}

/// The values of rank 0 on every rank.
std::vector<double> StateReader::shared(std::vector<double> values) {
    const bool is_short = rank_of(comm_) == 0 && !file_;
    fail_together(is_short ? path_ + ": ends too early" : "", comm_);
    auto count = static_cast<std::uint64_t>(values.size());
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, comm_);
    values.resize(count);
    in_messages(values.size(), [&](std::size_t at, int length) {
        MPI_Bcast(values.data() + at, length, MPI_DOUBLE, 0, comm_);
    });
    return values;
}

}  // namespace mpm
