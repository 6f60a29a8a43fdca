#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Machines and ranks of the parts of a call.
struct Ranks {
    int number = 1;
    int per_machine = 1;  ///< see mpi::Machines
    bool dealt = false;
};

/// Returns options with all defaults filled in, except the sizes of equal parts. `previous` may be
/// null.
Options complete(Options options, const Ranks& ranks, const Cuts* previous);

/// Throws Error with the option and its range if `options` are illegal.
void check_options(const Options& options, int dimension);

/// Throws Error if the arrays of the points do not fit together.
void check_lengths(const Points& points);

/// Throws Error as check_lengths(), or if weights are illegal.
void check_arrays(const Points& points);

/// Throws Error that names the first illegal weight and the number of such weights, or Error for
/// the sum of the weights. One of them must be illegal.
[[noreturn]] void reject_weights(const Points& points);

/// Throws Error with the first coordinate that is NaN or infinite, and their number. Some must be.
[[noreturn]] void reject_coordinates(const Points& points);

/// Returns the box of the points. Throws Error with the first illegal one and their number.
Box check_points(const Points& points);

/// Returns true if all coordinates are in one array, point after point, without anything else.
bool is_interleaved(const Points& points);

/// Throws Error with `name` unless the dimension is 1, 2 or 3.
void check_dimension(int dimension, const char* name);

/// Throws Error unless there are parts.
void require_parts(int num_parts);

/// Throws Error unless there are parts, and each of `parts` is one of them.
void check_parts(std::span<const Part> parts, int num_parts);

/// Throws Error unless all ranks are below `num_ranks`.
void check_ranks(std::span<const RankRange> ranks_of_parts, int num_ranks);

inline constexpr const char* illegal_cut =
    "a cut has an axis that the points lack, NaN in at, or a divides that is neither 0 nor 1; give "
    "the cuts of a balance unchanged";

inline constexpr const char* illegal_numbers =
    "the numbers of cuts must name each part once, and their debt be finite; give the cuts of a "
    "balance unchanged";

/// Throws Error if cuts are neither a tree nor a part of one.
void check_tree(const Cuts& cuts);

/// Throws Error if a look-up of positions by these cuts would leave an array. Ignores weights, and
/// coordinates that are not finite.
void check_positions(const Points& positions, const Cuts& cuts);

/// Throws Error if the cuts of an earlier call do not fit these options.
void check_previous(const Cuts& previous, const Options& options, int dimension);

/// Scales checked sizes to a sum in [1, 2), so that weights over sizes stay in range; makes equal
/// ones if there are none. By a power of two, which leaves ratios bit-identical, except for sizes
/// hundreds of decades below the sum.
void normalize(std::vector<double>& sizes, int num_parts);

}  // namespace rrcb
