#include "balancers/balancers_mpi.hpp"
#include "output/history_mpi.hpp"
#include "output/probe_table_mpi.hpp"
#include "output/vtk_mpi.hpp"
#include "parallel/communicator_mpi.hpp"
#include "program/arguments.hpp"
#include "scene/scene_reports.hpp"
#include "scene_file/scene_file_mpi.hpp"

#include <rrcb/experimental/cost.hpp>

#include <mpi.h>
#include <mpm/simulation.hpp>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// Prints the kernels of a step, and the sizes of points and messages in bytes.
void list_kernels(const mpm::Simulation& simulation) {
    const auto& columns = simulation.particles().column_names();
    std::printf("kernels: %s\n", mpm::joined(simulation.kernels()).c_str());
    std::printf("columns: %s\n", mpm::joined(columns).c_str());
    std::printf("%zu bytes per point\n%zu bytes per migrated point\n%zu doubles per ghost node\n",
                columns.size() * sizeof(double), columns.size() * sizeof(double),
                simulation.doubles_per_ghost_node());
}

/// Writes the files that the output plan requests into a folder that rank 0 creates.
class Recorder {
  public:
    /// Collective over `comm`. `state_every` is as in Arguments.
    Recorder(const std::string& folder, const mpm::SceneFile& file, int state_every, MPI_Comm comm)
        : plan_(file.output),
          state_every_(state_every),
          folder_(made(folder, comm)),
          history_(folder + "/history.csv", file.scene, comm),
          vtk_(folder, file.scene, comm) {
        if (!file.scene.probes.empty()) probes_.emplace(folder + "/probes.csv", file.scene, comm);
    }

    /// Returns whether a state was written.
    bool record(const mpm::Simulation& simulation, bool is_last) {
        const bool is_time = passes(simulation.time());
        if (is_due(plan_.history_every, is_time, simulation, is_last)) {
            history_.write(simulation);
            if (probes_) probes_->write(simulation);
        }
        if (is_due(plan_.vtk_every, is_time, simulation, is_last)) vtk_.write(simulation);
        if (!is_due_by_steps(state_every_, simulation, is_last)) return false;
        simulation.write_state(folder_ + "/state_" + std::to_string(simulation.step_count()) +
                               ".mpm");
        return true;
    }

  private:
    static std::string made(const std::string& folder, MPI_Comm comm) {
        std::error_code error;
        if (mpm::rank_of(comm) == 0) std::filesystem::create_directories(folder, error);
        mpm::fail_together(error ? folder + ": " + error.message() : "", comm);
        return folder;
    }

    static bool is_due_by_steps(int every, const mpm::Simulation& simulation, bool is_last) {
        return every > 0 && (is_last || simulation.step_count() % every == 0);
    }

    bool is_due(int every, bool is_time, const mpm::Simulation& simulation, bool is_last) const {
        if (!(plan_.every_time > 0)) return is_due_by_steps(every, simulation, is_last);
        return every > 0 && (is_last || is_time);
    }

    /// Returns true for the first step at or after a multiple of the time between outputs.
    bool passes(double time) {
        if (!(plan_.every_time > 0) || time < next_time_) return false;
        // The factor is slightly above 1, so that round-off does not return the multiple just
        // passed.
        const double multiple = std::floor(time / plan_.every_time * (1 + 1e-12)) + 1;
        next_time_ = multiple * plan_.every_time;
        return true;
    }

    mpm::OutputPlan plan_;
    int state_every_;
    std::string folder_;
    double next_time_ = 0;
    mpm::History history_;
    mpm::VtkSeries vtk_;
    std::optional<mpm::ProbeTable> probes_;
};

/// Prints the share that is done and the time left: about once a second on a terminal, otherwise
/// one line for each tenth.
class Progress {
  public:
    Progress(double start_time, double end_time) : from_(start_time), to_(end_time) {}

    void show(const mpm::Simulation& simulation, bool is_last) {
        const double now = MPI_Wtime();
        const double share =
            to_ > from_ ? std::min((simulation.time() - from_) / (to_ - from_), 1.0) : 1;
        const bool is_due = is_terminal_ ? now - shown_ >= 1 : share >= 0.1 * (num_tenths_ + 1);
        if (!is_due && !(is_last && is_terminal_)) return;
        shown_ = now;
        num_tenths_ = static_cast<int>(10 * share + 1e-9);
        const double left = share > 0 ? (now - begin_) * (1 - share) / share : 0;
        std::fprintf(stderr, "%s%5.1f %% of %.4g s, step %lld, %.0f s left%s",
                     is_terminal_ ? "\r" : "", 100 * share, to_,
                     static_cast<long long>(simulation.step_count()), left,
                     is_last || !is_terminal_ ? "\n" : "   ");
    }

  private:
    double from_, to_;
    bool is_terminal_ = isatty(STDERR_FILENO) != 0;
    int num_tenths_ = 0;  ///< tenths that have been printed
    double begin_ = MPI_Wtime(), shown_ = begin_ - 1;
};

/// Whether to rebalance before the next step: before the first one, and then each so many steps, or
/// when it pays if `every` is 0. A restart keeps the division that it finds.
bool is_due(const mpm::Simulation& simulation, std::int64_t first_step, int every) {
    const std::int64_t step = simulation.step_count();
    if (step == first_step) return step == 0;
    return every > 0 ? step % every == 0 : simulation.due();
}

void simulate(mpm::Simulation& simulation, const mpm::Scene& scene, const Arguments& arguments,
              Recorder& recorder, MPI_Comm comm) {
    rrcb::experimental::CostModel* const costs =
        arguments.learns_cost ? &simulation.learn_costs() : nullptr;
    const auto weights = [&] {
        return costs->weights(costs->uses_costs() ? simulation.point_columns()
                                                  : std::vector<double>());
    };
    const auto new_balancer = [&] {
        return make_balancer(arguments.balancer, scene,
                             costs != nullptr ? PointWeights(weights) : PointWeights());
    };
    std::optional<mpm::Balancer> balancer = new_balancer();
    const std::int64_t first_step = simulation.step_count();
    Progress progress(simulation.time(), arguments.end_time);
    for (bool is_last = false; !is_last;) {
        is_last = !(simulation.time() < arguments.end_time);
        if (balancer && !is_last && is_due(simulation, first_step, arguments.every))
            simulation.rebalance(*balancer);
        // A restart does not know the earlier cuts. For the same results this run forgets them when
        // it writes a state.
        if (recorder.record(simulation, is_last)) balancer = new_balancer();
        if (mpm::rank_of(comm) == 0) progress.show(simulation, is_last);
        if (is_last) break;
        simulation.step();
    }
    if (mpm::rank_of(comm) == 0 && costs != nullptr) std::printf("%s\n", costs->report().c_str());
}

void print_end(const mpm::Simulation& simulation, const Arguments& arguments, double seconds) {
    const auto steps = static_cast<double>(simulation.step_count());
    std::printf("%s: %lld points, %lld steps to %.6g s in %.4g s (%.1f million point-steps/s)\n",
                arguments.scene.c_str(), static_cast<long long>(simulation.num_points()),
                static_cast<long long>(simulation.step_count()), simulation.time(), seconds,
                steps * static_cast<double>(simulation.num_points()) / seconds * 1e-6);
    std::printf("history: %s/history.csv\n", arguments.out.c_str());
}

/// Creates a simulation. Messages of its errors contain the name of the file.
mpm::Simulation start(const Arguments& arguments, const mpm::Scene& scene, MPI_Comm comm) {
    try {
        if (!arguments.restart.empty()) return {scene, arguments.restart, comm};
        return {scene, comm};
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(arguments.scene + ": " + error.what());
    }
}

void run(Arguments arguments, MPI_Comm comm) {
    mpm::SceneFile file = mpm::read_scene(arguments.scene, comm);
    if (arguments.cell_size > 0) mpm::resize_cells(file.scene, arguments.cell_size);
    if (arguments.every_time > 0) file.output.every_time = arguments.every_time;
    if (arguments.vtk_every >= 0) file.output.vtk_every = arguments.vtk_every;
    if (arguments.end_time > 0) file.scene.end_time = arguments.end_time;
    arguments.end_time = file.scene.end_time;
    mpm::Simulation simulation = start(arguments, file.scene, comm);
    if (arguments.list_kernels) {
        if (mpm::rank_of(comm) == 0) list_kernels(simulation);
        return;
    }
    if (mpm::rank_of(comm) == 0)
        for (const std::string& warning : mpm::scene_warnings(file.scene))
            std::fprintf(stderr, "rrcb_mpm: warning: %s: %s\n", arguments.scene.c_str(),
                         warning.c_str());
    Recorder recorder(arguments.out, file, arguments.state_every, comm);
    const double start_time = MPI_Wtime();
    simulate(simulation, file.scene, arguments, recorder, comm);
    if (mpm::rank_of(comm) == 0) print_end(simulation, arguments, MPI_Wtime() - start_time);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int exit_code = 0;
    try {
        const std::optional<Arguments> arguments = read_arguments(argc, argv);
        if (arguments) run(*arguments, MPI_COMM_WORLD);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "rrcb_mpm: there is not enough memory for more points\n");
        MPI_Abort(MPI_COMM_WORLD, 1);
    } catch (const std::exception& error) {
        if (mpm::rank_of(MPI_COMM_WORLD) == 0) std::fprintf(stderr, "rrcb_mpm: %s\n", error.what());
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
