// Runs a coarse slope and writes the bits of all columns of its points: write_bits FILE

#include "support.hpp"

#include <cstdio>
#include <fstream>

namespace {

bool write_bits(const char* path) {
    mpm::Simulation simulation(mpm::test::coarse_slope(), MPI_COMM_SELF);
    for (int step = 0; step < 200; ++step) simulation.step();
    std::ofstream file(path, std::ios::binary);
    for (const std::string& column : simulation.particles().column_names()) {
        const auto bytes = std::as_bytes(simulation.particles()[column]);
        file << column << '\n';
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    return file.good();
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const bool is_written = argc == 2 && write_bits(argv[1]);
    if (!is_written) std::fprintf(stderr, "write_bits FILE: a file that can be written\n");
    MPI_Finalize();
    return is_written ? 0 : 1;
}
