#include "zoltan/call/notices.hpp"

#include "zoltan/call/rcb_options.hpp"
#include "zoltan/real/message.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

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

double imbalance_of(const Report& report) {
    return std::isnan(report.imbalance) ? report.details.estimated_imbalance : report.imbalance;
}

/// Returns whether RCB_OUTPUT_LEVEL or FINAL_OUTPUT is above 0, or DEBUG_LEVEL at least 10. In the
/// last case Zoltan reports on REMAP.
bool asks_for_report_line(const Parameters& parameters) {
    constexpr int debug_all = 10;
    return parameters.output_level > 0 || parameters.final_output > 0 ||
           parameters.debug_level >= debug_all;
}

/// Returns the line of RCB_OUTPUT_LEVEL: the size, the imbalance, the rounds, and the number of
/// objects that new part numbers keep in place.
std::string report_line(const Report& report, int num_parts, const Remap& remap) {
    const Summary summary = summary_of(report, num_parts);
    std::string text =
        format("RRCB: %lld objects in %d parts, imbalance %.4f (%s), %d rounds",
               static_cast<long long>(summary.num_objects), num_parts, summary.imbalance,
               summary.is_measured ? "measured" : "estimated", report.details.rounds);
    if (remap.identity) return text;
    return text + format("; REMAP keeps %.1f %% of the objects in place instead of %.1f %%",
                         percent(remap.kept_after, remap.num_points),
                         percent(remap.kept_before, remap.num_points));
}

/// Returns the causes of an imbalance above the tolerance, one sentence for each.
std::vector<std::string> balance_warnings(const Report& report, const Parameters& parameters) {
    std::vector<std::string> texts;
    const double least = report.details.least_imbalance;
    const bool is_best = imbalance_of(report) <= least * (1 + 1e-9);
    if (least > parameters.options.imbalance_tolerance && report.details.num_empty_parts == 0 &&
        (is_best || report.details.coincident_cuts == 0)) {
        texts.push_back(
            format("one object outweighs a part, or objects are too few: the imbalance "
                   "is %.4f, at best %.4f",
                   imbalance_of(report), least));
    }
    const bool plain = parameters.rectilinear_blocks != 0;
    const bool divided = parameters.options.expert.coincident == Coincident::divide && !plain;
    if (report.details.coincident_cuts > 0 && !divided) {
        texts.push_back(format("%d cuts met objects in one %s; the imbalance is %.4f",
                               report.details.coincident_cuts,
                               plain ? "plane, which RCB_RECTILINEAR_BLOCKS keeps together"
                                     : "place, which stay together",
                               imbalance_of(report)));
    }
    return texts;
}

bool leaves_parts_empty(const Report& report) {
    return report.details.num_points > 0 && report.details.num_empty_parts > 0;
}

/// Prints the warnings and the line. Called on one rank.
void print_messages(const Report& report, int num_parts, const Remap& remap,
                    const Parameters& parameters, const char* function) {
    if (asks_for_report_line(parameters))
        std::printf("%s\n", report_line(report, num_parts, remap).c_str());
    if (parameters.debug_level <= 0) return;
    for (const std::string& warning : parameter_warnings(parameters)) {
        print_warning(0, function, warning);
    }
    for (const std::string& warning : balance_warnings(report, parameters))
        print_warning(0, function, warning);
    if (leaves_parts_empty(report)) {
        print_warning(0, function,
                      std::to_string(report.details.num_empty_parts) +
                          " parts stay empty: there are more parts than objects");
    } else if (report.details.all_weights_zero) {
        print_warning(0, function, "all weights are zero; balanced by number of objects");
    }
}

}  // namespace

Summary summary_of(const Report& report, int num_parts) {
    return {report.details.num_points, num_parts, imbalance_of(report),
            !std::isnan(report.imbalance)};
}

void print_notices(const Report& report, int num_parts, const Remap& remap, const State& state,
                   const char* function) noexcept {
    try {
        if (state.communicator->rank() == 0)
            print_messages(report, num_parts, remap, state.parameters, function);
    } catch (const std::exception&) {
        print_warning(0, function, "out of memory for messages");
    }
}

}  // namespace rrcb::zoltan
