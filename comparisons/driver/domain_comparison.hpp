#pragma once

#include "row.hpp"

#include <rrcb/method/statistical_domain.hpp>
#include <rrcb/points.hpp>

#include <string>
#include <vector>

namespace comparisons {

/// A kind of statistical domain, as the cells of one mesh make it.
struct DomainMaker {
    std::string name;
    int (*bytes_per_cell)(int dimension);  ///< of what the root needs of a cell
    rrcb::StatisticalDomain (*make)(const rrcb::Points& points, int cells_per_axis);
};

/// Boxes of the moments, analytic, counts, samples of the paper; last the true shares of
/// sub-cells, which no guess within cells of that size can do better than.
const std::vector<DomainMaker>& domain_makers();

/// Points to divide by each kind.
struct DomainCase {
    std::string cloud;
    int dimension = 2;
    std::vector<double> coordinates;  ///< interleaved
    std::vector<double> weights;      ///< empty: 1 each

    rrcb::Points points() const {
        return rrcb::interleaved_points(coordinates, dimension, weights);
    }
};

/// Rows of domains.csv: each kind, in 8, 64 and 256 parts, on the meshes of several numbers of
/// bytes. What the root bisects is not refined. Not collective.
std::vector<Row> domain_rows(const DomainCase& points, bool quick);

/// The columns of domains.csv.
Row domain_columns();

}  // namespace comparisons
