#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>
#include <rrcb/points.hpp>
#include <rrcb/sorted_points.hpp>
#include <rrcb/statistical_domain.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rrcb {

/// The first thing a rank tells the root: whether it can go on, and what its records mean.
struct Header {
    std::int32_t failed = 0;  ///< 1: this rank can't
    std::int32_t dimension = 0;
    std::int32_t num_parts = 0;
    std::int32_t support_mesh = 0;    ///< as asked for
    std::int32_t cells_per_axis = 0;  ///< of this rank's mesh
    std::int32_t domain = 0;
    std::int32_t cut_rule = 0;
    std::int32_t refine = 0;
    double imbalance_tolerance = 0;
    double sigma_multiplier = 0;
    double sample_fraction = 0;
    std::uint64_t seed = 0;
    std::uint64_t part_sizes_hash = 0;
    std::uint64_t axes_hash = 0;      ///< of what the options say of axes and planes
    std::uint64_t previous_hash = 0;  ///< of the cuts of an earlier call; 0 without
    std::int64_t num_points = 0;
    std::int64_t num_records = 0;
    std::int64_t record_length = 0;  ///< doubles per record
    double weight = 0;
    double heaviest = 0;  ///< weight of one point
    Box box;              ///< of the support mesh
};

/// What one rank hands to the root: the moments of its cells, or its points, as plain doubles.
struct Contribution {
    Header header;
    std::vector<double> records;
    SortedPoints points;  ///< stays here, for the assignment; empty for DomainKind::points
};

/// Throws Error naming the option and its range when `options` can't be used.
void check_options(const Options& options, int dimension);

/// Box of the points; throws Error naming the first object and how many there are when they are
/// unusable.
Box check_points(const Points& points);

/// Throws Error when the cuts of an earlier call don't fit these options.
void check_previous(const Cuts& previous, const Options& options, int dimension);

/// Cells per axis of a rank's mesh where the options leave it open: enough for about a percent of
/// error on a smooth cloud, not so many that cells are nearly empty, and not more over all ranks
/// than the root can take in.
int automatic_cells_per_axis(int dimension, LocalIndex num_points, int num_ranks);

/// Reduces checked points to what the root needs of them: with earlier cuts no records at all.
Contribution contribute(const Points& points, const Box& box, const Options& options,
                        const Cuts* previous, int num_ranks);

/// Name of the first option that differs from the root's, with the rank; none when all agree.
std::optional<std::string> difference_between(std::span<const Header> headers);

/// The domain the root bisects, from everybody's headers and records in the order of the ranks.
StatisticalDomain build_domain(std::span<const Header> headers, std::span<const double> records,
                               const Options& options);

}  // namespace rrcb
