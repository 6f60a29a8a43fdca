#include "load_table.hpp"

#include <algorithm>

namespace comparisons {

LoadTable::LoadTable(int num_times, int num_parts)
    : num_times_(num_times),
      num_parts_(num_parts),
      loads_(static_cast<std::size_t>(num_times * num_times * num_parts)) {}

/// Of parts `age` old that were made at a recorded time; times in recorded ones.
double LoadTable::load_at_age(int made, double age, int part) const {
    const double at = std::min(made + age, num_times_ - 1.0);
    const int before = std::min(static_cast<int>(at), num_times_ - 2);
    const double share = at - before;
    return (1 - share) * load(made, before, part) + share * load(made, before + 1, part);
}

rrcb::StepLoad LoadTable::step(double made, double at) const {
    const int before = std::min(static_cast<int>(made), num_times_ - 2);
    const double share = made - before;
    rrcb::StepLoad step{1, 0};
    for (int part = 0; part < num_parts_; ++part) {
        const double mine = (1 - share) * load_at_age(before, at - made, part) +
                            share * load_at_age(before + 1, at - made, part);
        step.heaviest = std::max(step.heaviest, mine);
    }
    return step;
}

}  // namespace comparisons
