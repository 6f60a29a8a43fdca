#include "summary.hpp"

#include <cmath>
#include <cstdio>

namespace rrcb::zoltan {

namespace {

double percent(GlobalCount count, GlobalCount total) {
    return total == 0 ? 0 : 100.0 * static_cast<double>(count) / static_cast<double>(total);
}

template <typename... Arguments>
std::string format(const char* text, Arguments... arguments) {
    char line[160];
    std::snprintf(line, sizeof line, text, arguments...);
    return line;
}

}  // namespace

bool asks_for_summary(const Parameters& parameters) {
    constexpr int debug_all = 10;
    return parameters.output_level > 0 || parameters.final_output > 0 ||
           parameters.debug_level >= debug_all;
}

std::string summary(const Report& report, const Remap& remap) {
    const bool measured = !std::isnan(report.measured_imbalance);
    std::string text = format("RRCB: %lld objects in %zu parts, imbalance %.4f (%s), %d rounds",
                              static_cast<long long>(report.num_points), remap.numbers.size(),
                              measured ? report.measured_imbalance : report.estimated_imbalance,
                              measured ? "measured" : "estimated", report.rounds);
    if (remap.identity) return text;
    return text + format("; REMAP keeps %.1f %% of the objects in place instead of %.1f %%",
                         percent(remap.kept_after, remap.num_points),
                         percent(remap.kept_before, remap.num_points));
}

}  // namespace rrcb::zoltan
