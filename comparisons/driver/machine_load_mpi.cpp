#include "machine_load_mpi.hpp"

#include "text.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

namespace comparisons {

namespace {

std::optional<double> busy_seconds() {
    std::ifstream stat("/proc/stat");
    return read_busy_seconds(stat, static_cast<double>(sysconf(_SC_CLK_TCK)));
}

/// Processor time of this process, in and out of the system's functions.
double own_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string percent(const MachineUse& use) {
    return use.share_of_others ? fixed(100 * *use.share_of_others, 0) + " %" : "";
}

}  // namespace

/// A line "cpu user nice system idle iowait irq softirq steal guest guest_nice"; guests are part of
/// user and nice.
std::optional<double> read_busy_seconds(std::istream& stat, double ticks) {
    std::string name;
    double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft_irq = 0, steal = 0;
    stat >> name >> user >> nice >> system >> idle >> waiting >> irq >> soft_irq >> steal;
    if (!stat || name != "cpu") return std::nullopt;
    return (user + nice + system + irq + soft_irq + steal) / ticks;
}

MachineWatch::MachineWatch(MPI_Comm comm) : comm_(comm) {
    getloadavg(&load_average_, 1);
    MPI_Barrier(comm);
    start_s_ = MPI_Wtime();
    own_s_ = own_seconds();
    busy_s_ = busy_seconds();
}

MachineUse MachineWatch::use() const {
    double own_s = own_seconds() - own_s_;
    const double wall_s = MPI_Wtime() - start_s_;
    const std::optional<double> busy_s = busy_seconds();
    MachineUse use;
    use.load_average = load_average_;
    use.num_cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    MPI_Comm node = MPI_COMM_NULL;
    // Not those that --ranks-per-node makes up.
    PMPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    MPI_Comm_size(node, &use.num_ranks);
    MPI_Allreduce(MPI_IN_PLACE, &own_s, 1, MPI_DOUBLE, MPI_SUM, node);
    MPI_Comm_free(&node);
    constexpr double unknown = -1;
    double share = unknown;
    // Ticks are coarse: this program may seem to have used more than all.
    if (busy_s && busy_s_ && wall_s > 0)
        share = std::clamp((*busy_s - *busy_s_ - own_s) / (wall_s * use.num_cores), 0.0, 1.0);
    MPI_Allreduce(MPI_IN_PLACE, &share, 1, MPI_DOUBLE, MPI_MAX, comm_);
    if (share > unknown) use.share_of_others = share;
    return use;
}

void write_use(std::ostream& out, const MachineUse& use) {
    out << "load average at the start: " << fixed(use.load_average, 2)
        << "\nprocessor time used by other processes: " << percent(use) << "\nbusy: "
        << (use.is_busy()         ? "yes"
            : use.share_of_others ? "no"
                                  : "")
        << '\n';
    if (use.num_cores < use.num_ranks)
        out << "ranks per core: " << use.num_ranks << " ranks share " << use.num_cores
            << " cores\n";
}

void print_warning(std::ostream& out, const MachineUse& use) {
    if (!use.is_busy()) return;
    out << "busy machine: other processes used " << percent(use)
        << " of it while this ran; times are not to be trusted\n";
}

}  // namespace comparisons
