#include "lists/hungarian.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace rrcb {

namespace {

constexpr Part none = -1;

std::vector<Gain> merged(std::span<const Gain> gains) {
    std::vector<Gain> sorted(gains.begin(), gains.end());
    const auto pair = [](const Gain& gain) { return std::tie(gain.part, gain.number); };
    std::ranges::sort(sorted, {}, pair);
    std::vector<Gain> result;
    for (const Gain& gain : sorted) {
        if (result.empty() || pair(result.back()) != pair(gain)) {
            result.push_back(gain);
        } else {
            result.back().value += gain.value;
        }
    }
    return result;
}

/// The Hungarian method with potentials, one part after the other along a shortest path.
class Hungarian {
  public:
    Hungarian(std::span<const Gain> gains, int num_parts)
        : size_(static_cast<std::size_t>(num_parts)),
          cost_(size_ * size_, 0),
          part_potential_(size_, 0),
          number_potential_(size_, 0),
          part_of_(size_, free_) {
        // Scaled, so that keeping a number decides between equals and nothing else.
        const GlobalCount scale = num_parts + 1;
        for (const Gain& gain : gains) at(gain.part, gain.number) = -scale * gain.value;
        for (Part part = 0; part < num_parts; ++part) --at(part, part);
    }

    std::vector<Part> solve() {
        for (std::size_t part = 0; part < size_; ++part) add(part);
        std::vector<Part> numbers(size_);
        for (std::size_t number = 0; number < size_; ++number) {
            numbers[part_of_[number]] = static_cast<Part>(number);
        }
        return numbers;
    }

  private:
    struct Step {
        GlobalCount distance = std::numeric_limits<GlobalCount>::max();
        std::size_t previous = free_;  ///< number before this one on the path
        bool visited = false;
    };

    GlobalCount& at(Part part, Part number) {
        return cost_[static_cast<std::size_t>(part) * size_ + static_cast<std::size_t>(number)];
    }

    void add(std::size_t part) {
        std::vector<Step> steps(size_);
        GlobalCount total = 0;
        std::size_t number = free_;
        std::size_t reached = part;
        do {
            relax(reached, number, total, steps);
            number = nearest(steps);
            steps[number].visited = true;
            total = steps[number].distance;
            reached = part_of_[number];
        } while (reached != free_);
        update_potentials(part, total, steps);
        flip(part, number, steps);
    }

    void relax(std::size_t part, std::size_t from, GlobalCount total, std::vector<Step>& steps) {
        for (std::size_t number = 0; number < size_; ++number) {
            Step& step = steps[number];
            if (step.visited) continue;
            const GlobalCount distance = total + cost_[part * size_ + number] -
                                         part_potential_[part] - number_potential_[number];
            if (distance < step.distance) {
                step.distance = distance;
                step.previous = from;
            }
        }
    }

    std::size_t nearest(const std::vector<Step>& steps) const {
        std::size_t best = free_;
        for (std::size_t number = 0; number < size_; ++number) {
            if (steps[number].visited) continue;
            if (best == free_ || steps[number].distance < steps[best].distance) best = number;
        }
        return best;
    }

    void update_potentials(std::size_t part, GlobalCount total, const std::vector<Step>& steps) {
        part_potential_[part] += total;
        for (std::size_t number = 0; number < size_; ++number) {
            if (!steps[number].visited) continue;
            const GlobalCount slack = total - steps[number].distance;
            number_potential_[number] -= slack;
            if (part_of_[number] != free_) part_potential_[part_of_[number]] += slack;
        }
    }

    void flip(std::size_t part, std::size_t number, const std::vector<Step>& steps) {
        while (steps[number].previous != free_) {
            part_of_[number] = part_of_[steps[number].previous];
            number = steps[number].previous;
        }
        part_of_[number] = part;
    }

    static constexpr std::size_t free_ = std::numeric_limits<std::size_t>::max();

    std::size_t size_;
    std::vector<GlobalCount> cost_;
    std::vector<GlobalCount> part_potential_;
    std::vector<GlobalCount> number_potential_;
    std::vector<std::size_t> part_of_;  ///< which got this number
};

/// Numbers by the largest gain first; parts left over keep their number where it is free.
std::vector<Part> greedy(std::vector<Gain> gains, int num_parts) {
    std::ranges::sort(gains, [](const Gain& a, const Gain& b) {
        const bool a_moves = a.part != a.number;
        const bool b_moves = b.part != b.number;
        return std::tie(b.value, a_moves, a.part, a.number) <
               std::tie(a.value, b_moves, b.part, b.number);
    });
    std::vector<Part> numbers(static_cast<std::size_t>(num_parts), none);
    std::vector<char> used(numbers.size(), 0);
    const auto take = [&](Part part, Part number) {
        if (numbers[static_cast<std::size_t>(part)] != none) return;
        if (used[static_cast<std::size_t>(number)] != 0) return;
        numbers[static_cast<std::size_t>(part)] = number;
        used[static_cast<std::size_t>(number)] = 1;
    };
    for (const Gain& gain : gains) take(gain.part, gain.number);
    for (Part part = 0; part < num_parts; ++part) take(part, part);
    auto next_free = used.begin();
    for (Part part = 0; part < num_parts; ++part) {
        if (numbers[static_cast<std::size_t>(part)] != none) continue;
        next_free = std::find(next_free, used.end(), 0);
        take(part, static_cast<Part>(next_free - used.begin()));
    }
    return numbers;
}

}  // namespace

std::vector<Part> best_numbers(std::span<const Gain> gains, int num_parts) {
    std::vector<Gain> sums = merged(gains);
    if (num_parts <= most_parts_exact) return Hungarian(sums, num_parts).solve();
    return greedy(std::move(sums), num_parts);
}

}  // namespace rrcb
