#include "run_record.hpp"

#include "git_hash.hpp"
#include "measurement_mpi.hpp"
#include "text.hpp"

#include <rrcb/version.hpp>

#include <zoltan.h>

#include <sstream>

namespace comparisons {

std::string versions() {
    char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(mpi, &length);
    std::ostringstream text;
    text << "rrcb " << rrcb::version << " (" << git_hash << ")\n"
         << "Zoltan " << ZOLTAN_VERSION_NUMBER << '\n'
         << trim(mpi) << '\n';
    return text.str();
}

std::string command_line(int argc, char** argv) {
    std::string words;
    for (int i = 1; i < argc; ++i) words += std::string(i == 1 ? "" : " ") + argv[i];
    return words;
}

std::string run_record(const Arguments& arguments, const std::string& command, MPI_Comm comm) {
    int size = 0;
    MPI_Comm_size(comm, &size);
    std::ostringstream text;
    text << versions() << "arguments: " << command << "\nranks: " << size
         << "\nseed: " << arguments.seed << "\nparameters, all others are Zoltan's defaults:\n";
    for (const Method& method : arguments.methods) {
        text << "  " << method.label << ':';
        for (const auto& [name, value] : zoltan_parameters(method, arguments.lists)) {
            text << ' ' << name << '=' << value;
        }
        if (varies_with_seed(method)) {
            text << " and the next " << num_judged_seeds - 1 << " seeds";
        }
        text << '\n';
    }
    return text.str();
}

std::string definitions() {
    return "imbalance: heaviest part / mean part, the median where 10 seeds were tried.\n"
           "Lu: (ideal - actual) / ideal of a part.\n"
           "time: slowest rank, median of the repeats, first call left out.\n"
           "95 %: where the true median lies; of 6 repeats or more.\n"
           "times as fast: zoltan-rcb's time / this method's.\n"
           "messages, bytes: of one call over all ranks; a message counts once, at its sender;\n"
           "a collective counts 1 a rank, with the bytes the rank hands in and gets out.\n"
           "into root: bytes that rank 0 receives. moved: weight that changes rank.\n";
}

}  // namespace comparisons
