#include "results_folder_mpi.hpp"

#include "failure_mpi.hpp"

#include <fstream>

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
            // The file is renamed when it is complete. A run that is interrupted leaves either the
            // old or the new file.
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

}  // namespace comparisons
