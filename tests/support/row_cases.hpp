// Random rows of points, and trees of parts to divide them into.
#pragma once

#include "clouds.hpp"
#include "row_passes.hpp"

#include <rrcb/points.hpp>
#include <rrcb/tree_shape.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

namespace rrcb::test {

/// Cuts that a search starts from: none, if the owners of nodes search; those that rank 0 estimates
/// from moments; or estimated ones, moved.
enum class Start { nothing, estimate, anywhere };

struct RowCase {
    unsigned seed = 0;
    int dimension = 1;
    int num_ranks = 1;
    int num_parts = 1;
    TreeShape shape{};
    std::vector<std::vector<Row>> rows{};  ///< of each rank
    std::vector<double> part_sizes{};      ///< whole numbers
    double tolerance = 1.01;
    bool is_exact = false;
    bool plain_cuts = false;
    bool divides_coincident = false;
    Start start = Start::nothing;
    bool has_equal_weights = false;
};

inline std::ostream& operator<<(std::ostream& out, const RowCase& one) {
    std::size_t num_rows = 0;
    for (const auto& rows : one.rows) num_rows += rows.size();
    return out << "seed " << one.seed << ": " << one.dimension << "-D, " << one.num_ranks
               << " ranks, " << one.num_parts << " parts, " << num_rows << " rows, start "
               << static_cast<int>(one.start) << (one.is_exact ? ", exact" : "")
               << (one.plain_cuts ? ", plain" : "") << (one.divides_coincident ? ", divides" : "");
}

/// Makes cases from a seed.
class RowCases {
  public:
    explicit RowCases(unsigned seed) : engine_(seed) { case_.seed = seed; }

    RowCase make() {
        case_.dimension = 1 + below(3);
        case_.num_ranks = chance(0.1) ? 16 : 1 + below(8);
        case_.num_parts = chance(0.05) ? 1 + below(200) : 1 + below(20);
        case_.shape = {chance(0.5) ? 1 : 1 + below(case_.num_parts), chance(0.5)};
        case_.tolerance = 1 + std::pow(10, -3 + 2.5 * uniform(engine_));
        case_.is_exact = chance(0.5);
        case_.plain_cuts = chance(0.2);
        case_.divides_coincident = !case_.plain_cuts && chance(0.25);
        case_.start = static_cast<Start>(below(3));
        case_.part_sizes.assign(static_cast<std::size_t>(case_.num_parts), 1);
        if (chance(0.3)) {
            for (double& size : case_.part_sizes) size = below(5);
            case_.part_sizes[static_cast<std::size_t>(below(case_.num_parts))] = 2;
        }
        make_rows();
        return case_;
    }

  private:
    enum Cloud { even, lattice, decades, next_to_one, one_place, line, strays, crowd };
    enum Weights { ones, some, few, wide, sevens, none };

    bool chance(double share) { return uniform(engine_) < share; }
    int below(int end) { return static_cast<int>(uniform(engine_, 0, end)); }

    void make_rows() {
        cloud_ = static_cast<Cloud>(below(8));
        weights_ = chance(0.02) ? none : static_cast<Weights>(below(5));
        grid_ = 2 + below(12);
        const bool has_many = chance(0.05);
        const auto num_points = static_cast<LocalIndex>(has_many ? 2000 + below(3000)
                                                                 : std::pow(300, uniform(engine_)));
        const int most_in_row = has_many ? 400 : chance(0.5) ? 20 : 1;
        const int spread = below(3);
        case_.rows.resize(static_cast<std::size_t>(case_.num_ranks));
        for (LocalIndex count = 0; count < num_points;) {
            const Row row = make_row(most_in_row);
            const int rank = spread == 0   ? below(case_.num_ranks)
                             : spread == 1 ? static_cast<int>(count) * case_.num_ranks /
                                                 static_cast<int>(num_points)
                                           : below(2) * (case_.num_ranks - 1);
            case_.rows[static_cast<std::size_t>(rank)].push_back(row);
            count += row.count;
        }
        case_.has_equal_weights = weights_ == ones || weights_ == none || weights_ == sevens;
    }

    Row make_row(int most) {
        Row row;
        for (int a = 0; a < case_.dimension; ++a) row.first[static_cast<std::size_t>(a)] = place(a);
        row.axis = below(case_.dimension);
        row.count = static_cast<LocalIndex>(1 + below(most));
        row.step = chance(0.4) ? 0 : cloud_ == lattice ? 1 : cloud_ == next_to_one ? 0x1p-52 : 0.01;
        if (cloud_ == crowd) row.step = 0;
        row.weight = weight();
        return row;
    }

    double place(int axis) {
        const double u = uniform(engine_);
        switch (cloud_) {
            case lattice:
                return std::floor(grid_ * u);
            case decades:
                return (chance(0.5) ? 1 : -1) * std::pow(10, 60 * u - 30);
            case next_to_one:
                return 1 + std::floor(2000 * u) * 0x1p-52;
            case one_place:
                return 2.5;
            case line:
                return axis == 0 ? 1 : u;
            case strays:
                return chance(0.01) ? 1e6 * u : u;
            case crowd:
                return chance(0.5) ? 1 : 1 + std::ldexp(1.0, -below(53));
            default:
                return u;
        }
    }

    double weight() {
        switch (weights_) {
            case some:
                return below(2);
            case few:
                return below(10);
            case wide:
                return std::ldexp(1.0, below(30));
            case none:
                return 0;
            case sevens:
                return 7;
            default:
                return 1;
        }
    }

    std::mt19937_64 engine_;
    RowCase case_;
    Cloud cloud_ = even;
    Weights weights_ = ones;
    int grid_ = 2;
};

}  // namespace rrcb::test
