#include "materials/tresca.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

Eigen::Matrix3d matrix_of(const Stress<3>& s) {
    Eigen::Matrix3d matrix;
    matrix << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz;
    return matrix;
}

/// Principal values in descending order, which are the solver's from the last to the first.
Principal principal_of(const Solver& solver) {
    const Eigen::Vector3d& values = solver.eigenvalues();
    return {values[2], values[1], values[0]};
}

/// Principal stresses in plane strain, and the place among them of that along z.
struct PlanePrincipal {
    explicit PlanePrincipal(const Stress<2>& s) : radius(std::hypot(0.5 * (s.xx - s.yy), s.xy)) {
        const double mid = 0.5 * (s.xx + s.yy);
        values = {mid + radius, mid - radius, s.zz};
        along_z = s.zz > values[0] ? 0 : (s.zz > values[1] ? 1 : 2);
        std::ranges::sort(values, std::greater());
    }

    Principal values;
    std::size_t along_z;
    double radius;  ///< of Mohr's circle in the plane
};

}  // namespace

Principal returned_to_tresca(double strength, const Principal& trial) {
    const double excess = 0.5 * (trial[0] - trial[2]) - strength;
    if (!(excess > 0)) return trial;
    const Principal on_side{trial[0] - excess, trial[1], trial[2] + excess};
    if (on_side[0] >= on_side[1] && on_side[1] >= on_side[2]) return on_side;
    const double mean = (trial[0] + trial[1] + trial[2]) / 3, third = 2 * strength / 3;
    if (on_side[1] > on_side[0]) return {mean + third, mean + third, mean - 2 * third};
    return {mean + 2 * third, mean - third, mean - third};
}

template <>
Stress<2> returned_to_tresca<2>(double strength, const Stress<2>& trial) {
    const PlanePrincipal plane(trial);
    const Principal returned = returned_to_tresca(strength, plane.values);
    const double first = returned[plane.along_z == 0 ? 1 : 0];
    const double last = returned[plane.along_z == 2 ? 1 : 2];
    const double mid = 0.5 * (first + last);
    // Mohr's circle shrinks about its centre: the principal axes stay.
    const double scale = plane.radius > 0 ? 0.5 * (first - last) / plane.radius : 0;
    const double half_difference = 0.5 * (trial.xx - trial.yy) * scale;
    return {mid + half_difference, mid - half_difference, returned[plane.along_z],
            trial.xy * scale};
}

template <>
Stress<3> returned_to_tresca<3>(double strength, const Stress<3>& trial) {
    // The largest shear is at most sqrt(J2): what is below von Mises needs no principal axes.
    if (!(second_invariant(deviator(trial, mean(trial))) > strength * strength)) return trial;
    const Solver solver(matrix_of(trial));
    const Principal principal = principal_of(solver);
    const Principal values = returned_to_tresca(strength, principal);
    if (values == principal) return trial;
    const Eigen::Vector3d ascending(values[2], values[1], values[0]);
    const Eigen::Matrix3d s =
        solver.eigenvectors() * ascending.asDiagonal() * solver.eigenvectors().transpose();
    return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
}

template <>
double largest_shear<2>(const Stress<2>& stress) {
    const PlanePrincipal plane(stress);
    return 0.5 * (plane.values[0] - plane.values[2]);
}

template <>
double largest_shear<3>(const Stress<3>& stress) {
    const Solver solver(matrix_of(stress), Eigen::EigenvaluesOnly);
    return 0.5 * (solver.eigenvalues()[2] - solver.eigenvalues()[0]);
}

}  // namespace mpm
