#pragma once

#include <mpi.h>
#include <mpm/scene.hpp>

#include <string>

namespace mpm {

/// The number of steps between two outputs; 0: no output.
struct OutputPlan {
    int history_every = 10;
    int vtk_every = 0;
    double every_time = 0;  ///< time between outputs, s, which replaces both numbers of steps
                            ///< unless they are 0; 0: unused
};

/// The contents of a scene file: the scene, and its output.
struct SceneFile {
    Scene scene;
    OutputPlan output;
};

/// Returns the scene of a text. `name` is the name of the file, for errors and for the scene. Not
/// collective. Throws std::invalid_argument with the file, the place in it, the name of the
/// parameter and the allowed values.
SceneFile parse_scene(const std::string& text, const std::string& name);

/// Returns the scene of a YAML file, like parse_scene. Collective over `comm`: rank 0 reads the
/// file.
SceneFile read_scene(const std::string& path, MPI_Comm comm);

/// Changes the size of a scene's cells, m. The domain may grow by a part of a cell at its upper
/// sides.
void resize_cells(Scene& scene, double cell_size);

}  // namespace mpm
