// Runs a scene for some steps and writes the bits of all columns of its points:
// step_scene SCENE CELL_SIZE STEPS FILE
// It prints the number of points, and the materials and effects that the program has.

#include "effects/effect.hpp"
#include "materials/material.hpp"
#include "scene_file/scene_file_mpi.hpp"

#include <mpm/simulation.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace {

void write_bits(const mpm::Particles& particles, const char* path) {
    std::ofstream file(path, std::ios::binary);
    for (const std::string& column : particles.column_names()) {
        const auto bytes = std::as_bytes(particles[column]);
        file << column << '\n';
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    if (!file.flush()) throw std::runtime_error(std::string(path) + " cannot be written");
}

void print_kinds() {
    std::printf("has");
    for (const mpm::MaterialKind& kind : mpm::material_kinds())
        std::printf(" %s", kind.name.c_str());
    for (const mpm::EffectKind& kind : mpm::effect_kinds()) std::printf(" %s", kind.name.c_str());
    std::printf("\n");
}

void run(char** arguments) {
    mpm::Scene scene = mpm::read_scene(arguments[1], MPI_COMM_SELF).scene;
    mpm::resize_cells(scene, std::atof(arguments[2]));
    mpm::Simulation simulation(scene, MPI_COMM_SELF);
    for (int step = 0; step < std::atoi(arguments[3]); ++step) simulation.step();
    write_bits(simulation.particles(), arguments[4]);
    std::printf("points %lld\n", static_cast<long long>(simulation.num_points()));
    print_kinds();
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int code = 1;
    try {
        if (argc != 5) throw std::invalid_argument("wanted: SCENE CELL_SIZE STEPS FILE");
        run(argv);
        code = 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "step_scene: %s\n", error.what());
    }
    MPI_Finalize();
    return code;
}
