#include "results_folder_mpi.hpp"

#include "failure_mpi.hpp"

#include <fstream>
#include <sstream>

namespace comparisons {

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

void ResultsFolder::write(const std::string& name, const std::function<std::string()>& text) const {
    on_root(
        [&] {
            // Renamed when it is whole: a run that is stopped leaves the old rows or the new ones.
            const std::filesystem::path file = path_ / name;
            const std::filesystem::path draft = file.string() + ".new";
            std::ofstream out(draft);
            out << text();
            out.close();
            if (!out) throw Failure(file.string() + ": cannot be written; is the disk full?");
            std::filesystem::rename(draft, file);
        },
        comm_);
}

std::string ResultsFolder::from_root(const std::function<std::string()>& text) const {
    std::string all;
    on_root([&] { all = text(); }, comm_);
    return mpm::broadcast(all, comm_);
}

std::string ResultsFolder::read(const std::string& name) const {
    return from_root([&] {
        std::ifstream in(path_ / name);
        std::ostringstream text;
        if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
        return text.str();
    });
}

void ResultsFolder::append(const std::string& name,
                           const std::function<std::vector<Row>()>& rows) const {
    const std::string before = read(name);
    write(name, [&] {
        const std::vector<Row> more = rows();
        std::string text = before.empty() ? more.front().header() + '\n' : before;
        for (const Row& row : more) text += row.text() + '\n';
        return text;
    });
}

}  // namespace comparisons
