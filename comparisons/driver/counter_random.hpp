#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons {

/// One round of splitmix64: Steele, Lea, Flood, Fast splittable pseudorandom number generators
/// (2014), with Stafford's mix 13.
constexpr std::uint64_t scramble(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// Numbers that belong to one counter value: no state is shared between counters.
class CounterRandom {
  public:
    CounterRandom(std::uint64_t seed, std::uint64_t counter)
        : state_(scramble(scramble(seed) ^ counter)) {}

    std::uint64_t next() { return scramble(state_++); }

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

  private:
    std::uint64_t state_;
};

/// Seed of its own for a text, that other texts do not share.
constexpr std::uint64_t seed_for(std::string_view text, std::uint64_t seed) {
    for (const char c : text) seed = scramble(seed ^ static_cast<unsigned char>(c));
    return seed;
}

/// Numbers 0 ... count - 1 in an order that follows from the seed and the turn, so that no method
/// always comes after the same other one. An odd turn has the order of the turn before backwards: a
/// call finds in the caches what the call before it left, and each of two methods is first as
/// often.
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
