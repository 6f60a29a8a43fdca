#include "balance_mpi.hpp"
#include "estimate/decision_mpi.hpp"
#include "lists/duplicated_mpi.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

// Options::min_points: if a part has fewer points, the points are divided anew among fewer parts,
// the others getting size 0. Each attempt is a complete balance.

namespace rrcb {

namespace {

/// Parts allowed to have points, in ascending order, and how many of the first ones are to have
/// them.
struct UsedParts {
    std::vector<Part> parts{};
    std::vector<double> sizes{};  ///< of all parts
    int num_used = 0;

    UsedParts(const Options& options, int num_parts) : sizes(options.part_sizes) {
        if (sizes.empty()) sizes.assign(static_cast<std::size_t>(num_parts), 1.0);
        for (Part part = 0; part < num_parts; ++part)
            if (sizes[part] > 0) parts.push_back(part);
        num_used = static_cast<int>(parts.size());
    }

    std::vector<double> used_sizes() const {
        std::vector<double> used(sizes.size(), 0.0);
        for (int k = 0; k < num_used; ++k) used[parts[k]] = sizes[parts[k]];
        return used;
    }

    /// Returns the number of used parts with too few points; all must have enough, except a single
    /// one and empty ones after all others.
    int num_short(const std::vector<double>& counts, int min_points) const {
        int last = num_used;
        while (last > 1 && counts[parts[last - 1]] == 0) --last;
        if (last == 1) return 0;
        return static_cast<int>(std::count_if(parts.begin(), parts.begin() + last, [&](Part part) {
            return counts[part] < min_points;
        }));
    }
};

/// Changes the options and the parts for the next attempt.
void prepare_next(int num_short, GlobalCount num_points, UsedParts& used, Options& options) {
    const GlobalCount most = std::max(GlobalCount{1}, num_points / options.min_points);
    if (used.num_used > most) {
        used.num_used = static_cast<int>(most);
    } else if (options.refine != Refine::exact) {
        options.refine = Refine::exact;
    } else {
        used.num_used = std::max(1, used.num_used - std::max(num_short, used.num_used / 8));
    }
    options.num_parts = static_cast<int>(used.sizes.size());
    options.part_sizes = used.used_sizes();
}

/// Relates the report on the used parts to all of them.
void report_unused(const UsedParts& used, double tolerance, Report& report) {
    const std::vector<double> sizes = used.used_sizes();
    const double factor =
        std::reduce(used.sizes.begin(), used.sizes.end()) / std::reduce(sizes.begin(), sizes.end());
    report_measured(report.imbalance * factor, tolerance, report);
    report.details.estimated_imbalance *= factor;
    report.details.least_imbalance *= factor;
    report.details.surplus_parts = static_cast<int>(used.parts.size()) - used.num_used;
}

}  // namespace

Balance balance(PointPasses& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self) {
    Balance result = balance_once(points, options, previous, may_keep, self);
    const GlobalCount num_points = result.report.details.num_points;
    if (options.min_points == 0 || num_points == 0) return result;
    const int num_parts = result.cuts.num_parts;
    UsedParts used(options, num_parts);
    Options next = options;
    for (;;) {
        std::vector<Part> parts;
        Points counted;
        self.attempt([&] { parts = points.parts(); });
        counted.count = parts.size();
        const int num_short =
            used.num_short(part_weights(counted, parts, num_parts, self), options.min_points);
        if (num_short == 0) break;
        prepare_next(num_short, num_points, used, next);
        result = balance_once(points, next, previous, may_keep, self);
    }
    if (used.num_used < static_cast<int>(used.parts.size()))
        report_unused(used, options.imbalance_tolerance, result.report);
    return result;
}

}  // namespace rrcb
