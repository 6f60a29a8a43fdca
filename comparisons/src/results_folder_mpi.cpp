#include "results_folder_mpi.hpp"

#include "failure_mpi.hpp"

#include <fstream>
#include <sstream>

namespace comparisons {

namespace {

constexpr int number_digits = 9;

}  // namespace

ResultsFolder::ResultsFolder(const std::filesystem::path& path, MPI_Comm comm)
    : path_(path), comm_(comm) {
    on_root(
        [&] {
            std::error_code error;
            std::filesystem::create_directories(path / "data", error);
            if (error) {
                throw Failure("--out: " + path.string() + ": cannot make the folder: " +
                              error.message() + "; choose another one");
            }
        },
        comm);
}

void ResultsFolder::write(const std::string& name,
                          const std::function<void(std::ostream&)>& write) const {
    on_root(
        [&] {
            // Renamed when it is whole: a run that is stopped leaves the old rows or the new ones.
            const std::filesystem::path file = path_ / name;
            const std::filesystem::path draft = file.string() + ".new";
            std::ofstream out(draft);
            out.precision(number_digits);
            write(out);
            out.close();
            if (!out) throw Failure(file.string() + ": cannot be written; is the disk full?");
            std::filesystem::rename(draft, file);
        },
        comm_);
}

std::string ResultsFolder::from_root(const std::function<void(std::ostream&)>& write) const {
    std::string text;
    on_root(
        [&] {
            std::ostringstream out;
            out.precision(number_digits);
            write(out);
            text = out.str();
        },
        comm_);
    auto length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, comm_);
    text.resize(static_cast<std::size_t>(length));
    MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm_);
    return text;
}

std::vector<std::string> ResultsFolder::read_lines(const std::string& name) const {
    std::istringstream text(from_root([&](std::ostream& out) {
        std::ifstream in(path_ / name);
        if (in && in.peek() != std::ifstream::traits_type::eof()) out << in.rdbuf();
    }));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

}  // namespace comparisons
