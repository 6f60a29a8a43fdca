#include "scene_choice_mpi.hpp"

#include "failure.hpp"
#include "scene_file/scene_file_mpi.hpp"
#include "text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace comparisons {

namespace {

/// A shipped scene, and the values that replace those of its file.
struct SceneRow {
    std::string_view name;
    double cell_size = 0;  ///< m; 0: as in the file
    double end_time = 0;   ///< s; 0: as in the file
    /// Instructions of a point, a run of points, a node and a shared node in a step.
    std::array<double, 4> unit_costs{153, 544, 134, 535};
};

constexpr std::array<SceneRow, 6> rows{{
    {"slope"},
    {"submarine_slide"},
    {"torpedo_anchor"},
    {"dam_break", 0, 0, {1, 4088, 81, 629}},
    {"run_out"},
    // The cells of its file are larger and give too few points to distribute.
    {"elastic_structure", 0.0625, 1},
}};

const SceneRow* find_row(const std::string& name) {
    const auto found = std::ranges::find(rows, name, &SceneRow::name);
    return found == rows.end() ? nullptr : &*found;
}

mpm::Scene read(const std::string& file, MPI_Comm comm) {
    try {
        return mpm::read_scene(file, comm).scene;
    } catch (const std::invalid_argument& error) {
        throw Failure(std::string("--scene: ") + error.what());
    }
}

mpm::Scene read_shipped(const SceneRow& row, MPI_Comm comm) {
    mpm::Scene scene = read(RRCB_SCENES "/" + std::string(row.name) + ".yaml", comm);
    if (row.cell_size > 0) mpm::resize_cells(scene, row.cell_size);
    if (row.end_time > 0) scene.end_time = row.end_time;
    return scene;
}

}  // namespace

std::string scene_names() {
    return joined(rows, &SceneRow::name);
}

void check_scene(const std::string& name_or_file) {
    const std::string ending = std::filesystem::path(name_or_file).extension();
    if (find_row(name_or_file) != nullptr || ending == ".yaml") return;
    throw Failure("--scene: unknown value '" + name_or_file + "'; choose from: " + scene_names() +
                  ", or name a scene file (.yaml)");
}

std::vector<double> unit_costs(const std::string& name_or_file) {
    const SceneRow* row = find_row(name_or_file);
    const std::array<double, 4>& costs = (row != nullptr ? *row : rows.front()).unit_costs;
    return {costs.begin(), costs.end()};
}

mpm::Scene choose_scene(const std::string& name_or_file, bool quick, MPI_Comm comm) {
    const double quick_coarsening = name_or_file == "slope" ? 4 : 2;
    const SceneRow* row = find_row(name_or_file);
    mpm::Scene scene = row != nullptr ? read_shipped(*row, comm) : read(name_or_file, comm);
    if (quick) mpm::resize_cells(scene, quick_coarsening * scene.grid.spacing);
    return scene;
}

}  // namespace comparisons
