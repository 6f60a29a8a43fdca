#pragma once

#include <mpi.h>
#include <mpm/scene.hpp>

#include <string>

namespace mpm {

/// Steps between two outputs; 0: never.
struct OutputPlan {
    int history_every = 10;
    int vtk_every = 0;
    double every_time = 0;  ///< s, in place of the steps of both that are not 0; 0: by steps
};

/// A scene file: the scene, and its output.
struct SceneFile {
    Scene scene;
    OutputPlan output;
};

/// Scene of a text. `name` is that of the file, for errors and as the scene's name. Not collective.
/// Throws std::invalid_argument with the file, the place, the key and what is allowed.
SceneFile parse_scene(const std::string& text, const std::string& name);

/// Scene of a file in YAML, as parse_scene. Collective over `comm`: rank 0 reads.
SceneFile read_scene(const std::string& path, MPI_Comm comm);

/// Gives a scene's domain cells of another size, m. The domain may grow by part of a cell at its
/// upper sides.
void resize_cells(Scene& scene, double cell_size);

}  // namespace mpm
