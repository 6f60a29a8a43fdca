#include "collective/agreement_mpi.hpp"
#include "comparison_mpi.hpp"
#include "gather/cell_records.hpp"
#include "gather/contribution.hpp"
#include "gather/decision_mpi.hpp"
#include "gather/place.hpp"

namespace comparisons {

namespace {

/// Of cells that follow each other in a mesh.
std::size_t bytes_of_cells(std::size_t num_cells, int dimension) {
    std::vector<rrcb::CellMoments> cells(num_cells);
    for (std::size_t i = 0; i < num_cells; ++i) cells[i].cell = i;
    const rrcb::Box unit{{0, 0, 0}, {1, 1, 1}};
    std::vector<double> records;
    rrcb::append_lean_cells(cells, rrcb::make_support_mesh(unit, dimension, 2), records);
    return records.size() * sizeof(double);
}

std::size_t bytes_of_place(int dimension) {
    std::vector<double> doubles;
    rrcb::append_place(rrcb::Place(), dimension, doubles);
    return doubles.size() * sizeof(double);
}

}  // namespace

std::string message_sizes_csv(int dimension) {
    struct Size {
        std::string name;
        std::size_t bytes = 0;
    };
    // Several, as cells are packed into doubles.
    constexpr std::size_t several = 16;
    const std::size_t cell =
        (bytes_of_cells(several + 1, dimension) - bytes_of_cells(1, dimension)) / several;
    const std::vector<Size> sizes = {{"agreement", sizeof(rrcb::Shared::value)},
                                     {"cut", sizeof(rrcb::Cut)},
                                     {"bracket", sizeof(rrcb::Bracket)},
                                     {"head", sizeof(rrcb::Head)},
                                     {"verdict", sizeof(rrcb::Verdict)},
                                     {"summary", sizeof(rrcb::Summary)},
                                     {"mesh", bytes_of_cells(1, dimension) - cell},
                                     {"cell", cell},
                                     {"place", bytes_of_place(dimension)},
                                     {"part_weight", sizeof(double)}};
    return csv_of(sizes, [](const Size& size) {
        return Row().add("name", size.name).add("bytes", size.bytes);
    });
}

}  // namespace comparisons
