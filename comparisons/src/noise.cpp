#include "noise.hpp"

#include "text.hpp"

namespace comparisons {

void write_noise(std::ostream& out, std::span<const Noise> noise) {
    out << "workload,what,ratio,low,high\n";
    for (const auto& [workload, what, ratio] : noise) {
        out << csv_field(workload) << ',' << csv_field(what) << ',' << write_number(ratio.median)
            << ',' << interval_fields(ratio.interval95) << '\n';
    }
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
