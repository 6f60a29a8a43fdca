#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons {

/// Computes one round of splitmix64 with Stafford's mix 13. See Steele, Lea, Flood: Fast splittable
/// pseudorandom number generators (2014).
constexpr std::uint64_t scramble(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// Generates pseudo-random numbers that depend only on a counter's value. No state is shared.
class CounterRandom {
  public:
    CounterRandom(std::uint64_t seed, std::uint64_t counter)
        : state_(scramble(scramble(seed) ^ counter)) {}

    std::uint64_t next() { return scramble(state_++); }

    /// Returns a number uniformly distributed in [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

  private:
    std::uint64_t state_;
};

/// Returns a seed that depends on a text, so that different texts have different seeds.
constexpr std::uint64_t seed_for(std::string_view text, std::uint64_t seed) {
    for (const char c : text) seed = scramble(seed ^ static_cast<unsigned char>(c));
    return seed;
}

/// Returns the numbers 0 ... count - 1 in a random order that depends on the seed and the turn. In
/// this way no method always follows the same other one, whose data it would find in the caches.
/// Each odd turn has the reverse order of the previous turn, so that of two methods each is first
/// equally often.
inline std::vector<std::size_t> drawn_order(std::size_t count, std::uint64_t seed,
                                            std::uint64_t turn) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    CounterRandom random(seed, turn / 2);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);
    if (turn % 2 == 1) std::ranges::reverse(order);
    return order;
}

}  // namespace comparisons
