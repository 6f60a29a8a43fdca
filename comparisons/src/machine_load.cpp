#include "machine_load.hpp"

#include <algorithm>
#include <sstream>
#include <string>

namespace comparisons {

namespace {

/// The time of a line "cpu user nice system idle iowait irq softirq steal guest guest_nice" that
/// was not idle; guests are part of user and nice.
std::optional<double> busy_ticks(std::istringstream& line) {
    constexpr int idle = 3;
    constexpr int waiting = 4;
    constexpr int first_guest = 8;
    double busy = 0;
    double ticks = 0;
    int column = 0;
    for (; column < first_guest && line >> ticks; ++column) {
        if (column != idle && column != waiting) busy += ticks;
    }
    return column > idle ? std::optional(busy) : std::nullopt;
}

}  // namespace

std::optional<ProcessorTime> read_processor_time(std::istream& stat, double ticks) {
    ProcessorTime time;
    std::optional<double> busy;
    for (std::string text; std::getline(stat, text) && text.starts_with("cpu");) {
        std::istringstream line(text);
        std::string name;
        line >> name;
        if (name == "cpu") {
            busy = busy_ticks(line);
        } else {
            ++time.num_cores;
        }
    }
    if (!busy || time.num_cores == 0 || !(ticks > 0)) return std::nullopt;
    time.busy_s = *busy / ticks;
    return time;
}

std::optional<double> share_of_others(const ProcessorTime& start, const ProcessorTime& end,
                                      double own_s, double wall_s) {
    const double available_s = wall_s * end.num_cores;
    if (!(available_s > 0)) return std::nullopt;
    return std::clamp((end.busy_s - start.busy_s - own_s) / available_s, 0.0, 1.0);
}

}  // namespace comparisons
