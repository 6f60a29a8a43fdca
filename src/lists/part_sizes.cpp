#include "options/rejection.hpp"

#include <rrcb/part_sizes.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

std::vector<double> balanced_sizes(std::span<const double> loads,
                                   std::span<const double> part_sizes) {
    // Ghosts grow less than points, so a full correction would overshoot.
    constexpr double damping = 0.7;
    constexpr double most = 2;
    require(part_sizes.empty() || part_sizes.size() == loads.size(),
            "part_sizes must hold one entry per part, or none for equal parts");
    const auto is_size = [](double number) { return number >= 0 && std::isfinite(number); };
    require(std::ranges::all_of(loads, is_size), "loads must be finite, 0 or more");
    require(std::ranges::all_of(part_sizes, is_size), "part_sizes must be finite, 0 or more");
    return locally([&] {
        std::vector<double> sizes(part_sizes.begin(), part_sizes.end());
        if (part_sizes.empty()) sizes.assign(loads.size(), 1);
        const double before = std::accumulate(sizes.begin(), sizes.end(), 0.0);
        const auto counts = [&](std::size_t p) { return sizes[p] > 0 && loads[p] > 0; };
        double sum = 0;
        double number = 0;
        for (std::size_t p = 0; p < sizes.size(); ++p) {
            if (!counts(p)) continue;
            sum += loads[p];
            ++number;
        }
        for (std::size_t p = 0; p < sizes.size(); ++p)
            if (counts(p))
                sizes[p] *= std::clamp(std::pow(sum / number / loads[p], damping), 1 / most, most);
        const double after = std::accumulate(sizes.begin(), sizes.end(), 0.0);
        if (after > 0)
            for (double& size : sizes) size *= before / after;
        return sizes;
    });
}

}  // namespace rrcb
