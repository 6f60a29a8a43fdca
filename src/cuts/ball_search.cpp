#include "cuts/ball_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

BallSearch::BallSearch(const Cuts& cuts, double radius, std::span<const char> is_wanted)
    : cuts_(cuts),
      reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
      unit_(reach_ > 0 ? reach_ : 1),
      num_wanted_before_(is_wanted.size() + 1, 0) {
    std::inclusive_scan(is_wanted.begin(), is_wanted.end(), num_wanted_before_.begin() + 1,
                        std::plus<>(), 0);
}

bool BallSearch::is_near(const Vector& apart) const {
    double square = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(cuts_.dimension); ++a) {
        if (apart[a] > reach_) return false;
        if (apart[a] > 0) square += (apart[a] / unit_) * (apart[a] / unit_);
    }
    return square <= 1 + 8 * epsilon;
}

}  // namespace rrcb
