#include "machine_load_mpi.hpp"

#include "text.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

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

std::optional<ProcessorTime> processor_time() {
    std::ifstream stat("/proc/stat");
    return read_processor_time(stat, static_cast<double>(sysconf(_SC_CLK_TCK)));
}

/// Processor time of this process, in and out of the system's functions.
double own_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::optional<double> load_average_of_a_minute() {
    double average = 0;
    return getloadavg(&average, 1) == 1 ? std::optional(average) : std::nullopt;
}

std::string percent(double share) {
    return fixed(100 * share, 0) + " %";
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

MachineWatch::MachineWatch(MPI_Comm comm) : comm_(comm), load_average_(load_average_of_a_minute()) {
    MPI_Barrier(comm);
    start_s_ = MPI_Wtime();
    own_s_ = own_seconds();
    time_ = processor_time();
}

MachineUse MachineWatch::use() const {
    double own_s = own_seconds() - own_s_;
    const double wall_s = MPI_Wtime() - start_s_;
    const std::optional<ProcessorTime> now = processor_time();
    MachineUse use;
    MPI_Comm node = MPI_COMM_NULL;
    MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    MPI_Comm_size(node, &use.num_ranks);
    MPI_Allreduce(MPI_IN_PLACE, &own_s, 1, MPI_DOUBLE, MPI_SUM, node);
    MPI_Comm_free(&node);
    constexpr double unknown = -1;
    double share = unknown;
    if (time_ && now) share = share_of_others(*time_, *now, own_s, wall_s).value_or(unknown);
    MPI_Allreduce(MPI_IN_PLACE, &share, 1, MPI_DOUBLE, MPI_MAX, comm_);
    if (share > unknown) use.share_of_others = share;
    use.load_average = load_average_;
    use.num_cores = static_cast<int>(std::thread::hardware_concurrency());
    return use;
}

void write_use(std::ostream& out, const MachineUse& use) {
    out << "load average at the start: " << (use.load_average ? fixed(*use.load_average, 2) : "")
        << "\nprocessor time used by other processes: "
        << (use.share_of_others ? percent(*use.share_of_others) : "") << "\nbusy: "
        << (!use.share_of_others ? ""
            : use.is_busy()      ? "yes"
                                 : "no")
        << '\n';
    if (use.num_cores > 0 && use.num_cores < use.num_ranks) {
        out << "ranks per core: " << use.num_ranks << " ranks share " << use.num_cores
            << " cores\n";
    }
}

void print_warning(std::ostream& out, const MachineUse& use) {
    if (!use.is_busy()) return;
    out << "busy machine: other processes used " << percent(*use.share_of_others)
        << " of it while this ran; times are not to be trusted\n";
}

}  // namespace comparisons
