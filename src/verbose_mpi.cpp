#include "verbose_mpi.hpp"

#include <rrcb/version.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace rrcb {

bool is_verbosity_asked() {
    const char* value = std::getenv("RRCB_VERBOSE");
    return value != nullptr && *value != '\0' && std::string_view(value) != "0";
}

void print_line(const Balance& made, const Options& options, double start,
                const Participant& self) {
    if (!is_verbosity_asked() || mpi::rank_of(self.comm) != 0) return;
    const Report& report = made.report;
    const bool is_measured = !std::isnan(report.imbalance);
    const double imbalance = is_measured ? report.imbalance : report.details.estimated_imbalance;
    std::printf("RRCB %s: %lld points in %d parts, imbalance %.4f%s, %d rounds, %.2f ms", version(),
                static_cast<long long>(report.details.num_points), made.cuts.num_parts, imbalance,
                is_measured ? "" : " (estimated)", report.details.rounds,
                1e3 * (MPI_Wtime() - start));
    // The tolerance is probably meant in per cent.
    const double tolerance = options.imbalance_tolerance;
    if (tolerance >= 2)
        std::printf("; a part may weigh %g times the mean, for %g %% set imbalance_tolerance to %g",
                    tolerance, tolerance, 1 + tolerance / 100);
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace rrcb
