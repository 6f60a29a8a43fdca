// A scene file: read, or refused with its name.
#include "fuzzing.hpp"

#include <scene_file/scene_file_mpi.hpp>

#include <stdexcept>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using rrcb::fuzz::expect;
    const std::string text(rrcb::fuzz::text_of(data, size));
    try {
        const mpm::SceneFile file = mpm::parse_scene(text, "scene.yaml");
        expect(file.scene.dimension == 2 || file.scene.dimension == 3, "2 or 3 dimensions");
        expect(file.scene.grid.spacing > 0, "cells of some size");
        expect(file.output.history_every >= 0 && file.output.vtk_every >= 0, "steps in range");
    } catch (const std::invalid_argument& error) {
        expect(std::string_view(error.what()).starts_with("scene.yaml: "), "the file is named");
    }
    return 0;
}
