#include "noise.hpp"

#include "text.hpp"

namespace comparisons {

Row noise_row(const Noise& noise) {
    return Row()
        .add("workload", noise.workload)
        .add("what", noise.what)
        .add("ratio", noise.ratio.median)
        .add_interval("", noise.ratio.interval95);
}

void print_noise(std::ostream& out, std::span<const Noise> noise) {
    for (const auto& [workload, what, ratio] : noise) {
        out << "noise: " << what << " of " << workload << " measured twice: second / first "
            << fixed(ratio.median, 3);
        if (ratio.interval95) {
            out << " (95 %: " << fixed(ratio.interval95->low, 3) << " ... "
                << fixed(ratio.interval95->high, 3) << ')';
        }
        out << '\n';
    }
}

}  // namespace comparisons
