#include "verbose_mpi.hpp"

#include "balance_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/version.hpp>

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace rrcb {

namespace {

void print_line(const Balance& made, double seconds) {
    const Report& report = made.report;
    const bool is_measured = !std::isnan(report.imbalance);
    const double imbalance = is_measured ? report.imbalance : report.details.estimated_imbalance;
    std::printf("RRCB %s: %lld points in %d parts, imbalance %.4f%s, %d rounds, %.2f ms\n",
                version(), static_cast<long long>(report.details.num_points), made.cuts.num_parts,
                imbalance, is_measured ? "" : " (estimated)", report.details.rounds, 1e3 * seconds);
    std::fflush(stdout);
}

}  // namespace

bool is_verbosity_asked() {
    const char* value = std::getenv("RRCB_VERBOSE");
    return value != nullptr && *value != '\0' && std::string_view(value) != "0";
}

Balance balance_aloud(const Points& points, const Options& options, const Cuts& previous,
                      Participant& self, std::vector<Part> memory) {
    const bool prints = is_verbosity_asked() && mpi::rank_of(self.comm) == 0;
    const double start = prints ? MPI_Wtime() : 0;
    // No call starts from empty cuts.
    const Cuts* from = previous.dimension == 0 && previous.tree.empty() ? nullptr : &previous;
    Balance made = balance(points, options, from, true, self, std::move(memory));
    if (prints) print_line(made, MPI_Wtime() - start);
    return made;
}

}  // namespace rrcb
