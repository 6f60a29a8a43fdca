#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Ranks and machines of a call.
struct Ranks {
    int number = 1;
    int per_machine = 1;  ///< see mpi::Machines
    bool dealt = false;
};

/// Returns the options with all defaults filled in, except that part sizes remain empty for equal
/// parts. `previous` may be null.
Options complete(Options options, const Ranks& ranks, const Cuts* previous);

/// Throws Error if an option is illegal. The text contains the option and its range.
void check_options(const Options& options, int dimension);

/// Throws Error if the arrays of the points do not fit together.
void check_lengths(const Points& points);

/// Throws Error as check_lengths(), or if weights are illegal.
void check_arrays(const Points& points);

/// Throws Error that contains the first illegal weight and the number of illegal weights, or, if
/// only the sum of the weights is illegal, an Error about the sum. The weights or their sum must be
/// illegal.
[[noreturn]] void reject_weights(const Points& points);

/// Throws Error with the first coordinate that is NaN or infinite, and their number. There must be
/// one.
[[noreturn]] void reject_coordinates(const Points& points);

/// Returns the box of the points. Throws Error with the first illegal point and the number of such
/// points.
Box check_points(const Points& points);

/// Returns true if all coordinates are interleaved in one array that contains nothing else.
bool is_interleaved(const Points& points);

/// Returns the size of a coordinate in bytes.
std::size_t scalar_bytes(const Points& points);

/// Throws Error if the coordinates do not fit the dimension and number of the points. They may be
/// NaN or infinite.
void check_layout(const Points& points);

/// Throws Error with `name` unless the dimension is 1, 2 or 3.
void check_dimension(int dimension, const char* name);

/// Throws Error unless there is at least one part.
void require_parts(int num_parts);

/// Throws Error unless there is at least one part, and each entry of `parts` is from 0 to num_parts
/// - 1.
void check_parts(std::span<const Part> parts, int num_parts);

/// Throws Error unless all ranks are below `num_ranks`.
void check_ranks(std::span<const RankRange> ranks_of_parts, int num_ranks);

inline constexpr const char* illegal_cut =
    "a cut has an axis that the points lack, NaN in at, or a divides that is neither 0 nor 1; give "
    "the cuts of a balance unchanged";

inline constexpr const char* illegal_numbers =
    "the numbers of cuts must name each part once, and their debt be finite; give the cuts of a "
    "balance unchanged";

/// Throws Error if the cuts are neither a tree nor a part of a tree.
void check_tree(const Cuts& cuts);

/// Throws Error if a look-up of positions by these cuts would read beyond an array. Ignores
/// weights, and coordinates that are not finite.
void check_positions(const Points& positions, const Cuts& cuts);

/// Throws Error if the cuts of an earlier call do not fit the options.
void check_previous(const Cuts& previous, const Options& options, int dimension);

/// Scales checked sizes by a power of two, so that their sum is in [1, 2) and weights divided by
/// sizes do not overflow. Ratios remain bit-identical, except for sizes hundreds of decades below
/// the sum. If there are no sizes, makes equal ones.
void normalize(std::vector<double>& sizes, int num_parts);

}  // namespace rrcb
