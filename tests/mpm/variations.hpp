#pragma once

#include "scene_file/scene_file_mpi.hpp"
#include "support.hpp"

#include <array>
#include <ostream>

namespace mpm::test {

/// Factors of a scene's stiffness, time step and cells. A result may depend on none of them.
struct Variation {
    double modulus = 1, courant_number = 1, cell_size = 1;
};

inline constexpr std::array variations{Variation{}, Variation{.modulus = 4},
                                       Variation{.courant_number = 0.5},
                                       Variation{.cell_size = 0.5}};

inline std::ostream& operator<<(std::ostream& out, const Variation& varied) {
    return out << "modulus * " << varied.modulus << ", courant_number * " << varied.courant_number
               << ", cell_size * " << varied.cell_size;
}

inline void vary(Scene& scene, const Variation& varied) {
    for (Material& material : scene.materials) {
        auto& modulus = std::get<double>(material.parameters["youngs_modulus"]);
        modulus *= varied.modulus;
    }
    scene.courant_number *= varied.courant_number;
    resize_cells(scene, scene.grid.spacing * varied.cell_size);
}

/// A shipped scene, varied. Collective.
inline Scene shipped(const std::string& name, const Variation& varied = {}) {
    Scene scene = read_scene(RRCB_SCENES "/" + name + ".yaml", MPI_COMM_WORLD).scene;
    vary(scene, varied);
    return scene;
}

/// A shipped scene in cells of another size. Collective.
inline Scene shipped(const std::string& name, double cell_size) {
    Scene scene = shipped(name);
    resize_cells(scene, cell_size);
    return scene;
}

}  // namespace mpm::test
