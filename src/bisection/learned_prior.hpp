#pragma once

#include <Eigen/Core>

namespace rrcb {

/// Sub-cells per axis of a cell.
inline constexpr int num_sub = 8;

/// A number for each sub-cell; those along the last axis follow one another.
using SubCells = Eigen::Matrix<double, num_sub * num_sub, 1>;

/// What the prior knows of one cell.
struct CellInputs {
    double ratio = 0;           ///< weight / (weight + weight of the cell in the middle)
    double mean[2] = {0, 0};    ///< from the centre, in cells
    double deviation[2]{0, 0};  ///< in cells; with no weight 0
    bool is_outside = false;    ///< of the mesh: nobody knows what lies there
};

/// What the prior knows of a cell and those around it, in 2-D.
struct Neighbourhood {
    CellInputs cells[3][3];  ///< by axis 0, then axis 1
    double count = 0;        ///< points in the middle
};

/// Exponents whose exp() is the density expected in each sub-cell of the middle, but for a factor
/// and a tilt: a perceptron, learned by tools/train_domain. Not collective.
SubCells learned_prior(const Neighbourhood& around);

}  // namespace rrcb
