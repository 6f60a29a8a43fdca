#include "machine_load_mpi.hpp"

#include "text.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace comparisons {

namespace {

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
