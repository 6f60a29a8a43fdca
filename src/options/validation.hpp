#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>
#include <rrcb/points.hpp>

#include <vector>

namespace rrcb {

/// Machines and ranks of the parts of a call.
struct Ranks {
    int number = 1;
    int per_machine = 1;  ///< see mpi::Machines
    bool dealt = false;
};

/// Options with nothing left to default except the sizes of equal parts. `previous` may be null.
Options complete(Options options, const Ranks& ranks, const Cuts* previous);

/// Throws Error naming the option and its range when `options` can't be used.
void check_options(const Options& options, int dimension);

/// Throws Error when the arrays of the points do not fit together, or weights are unusable.
void check_arrays(const Points& points);

/// Throws the Error that names the first coordinate that is NaN or infinite, of points that have
/// one, and how many there are.
[[noreturn]] void reject_coordinates(const Points& points);

/// Box of the points; throws Error naming the first object and how many there are when they are
/// unusable.
Box check_points(const Points& points);

/// True when all coordinates are in one array, point after point, without anything else.
bool is_interleaved(const Points& points);

/// Throws Error that names what has another number of axes than 1, 2 or 3.
void check_dimension(int dimension, const char* name);

/// Throws Error when cuts are neither a tree nor a part of one.
void check_tree(const Cuts& cuts);

/// Throws Error when a look-up of positions by these cuts would leave an array. Weights, and
/// whether coordinates are finite, are not looked at.
void check_positions(const Points& positions, const Cuts& cuts);

/// Throws Error when cuts are no whole tree.
void check_cuts(const Cuts& cuts);

/// Throws Error when the cuts of an earlier call don't fit these options.
void check_previous(const Cuts& previous, const Options& options, int dimension);

/// Scales checked sizes to a sum in [1, 2), so that weights over sizes stay in range; makes equal
/// ones if there are none. A power of two keeps the bits of their ratios, except for sizes hundreds
/// of decades below their sum.
void normalize(std::vector<double>& sizes, int num_parts);

}  // namespace rrcb
