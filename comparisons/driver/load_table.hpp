#pragma once

#include "controller/rebalance_rule.hpp"

#include <cstddef>
#include <vector>

namespace comparisons {

/// Loads of the parts at recorded times, over their mean, by parts made at recorded times.
///
/// Between the times loads are interpolated: those of equally old parts. Numbers of times may be
/// fractions, and there are two times at least. Nothing here communicates.
class LoadTable {
  public:
    LoadTable(int num_times, int num_parts);

    /// Of a part at recorded time `at`, where the parts were made at time `made`, at most `at`.
    double& load(int made, int at, int part) { return loads_[index(made, at, part)]; }
    double load(int made, int at, int part) const { return loads_[index(made, at, part)]; }

    /// With the mean 1.
    rrcb::StepLoad step(double made, double at) const;

  private:
    std::size_t index(int made, int at, int part) const {
        return static_cast<std::size_t>((made * num_times_ + at) * num_parts_ + part);
    }
    double load_at_age(int made, double age, int part) const;

    int num_times_;
    int num_parts_;
    std::vector<double> loads_;
};

}  // namespace comparisons
