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

void ResultsFolder::write(const std::string& name,
                          const std::function<void(std::ostream&)>& write) const {
    on_root(
        [&] {
            const std::filesystem::path file = path_ / name;
            std::ofstream out(file);
            out.precision(9);
            write(out);
            out.close();
            if (!out) throw Failure(file.string() + ": cannot be written; is the disk full?");
        },
        comm_);
}

}  // namespace comparisons
