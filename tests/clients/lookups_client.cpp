// Look-ups on a lattice, where many points lie on every cut, under Zoltan's RCB and under RRCB: how
// many points are not found in the part they were given, and what look-ups cost.
#include "program.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

using rrcb::zoltan_test::Outcome;
using rrcb::zoltan_test::Program;

constexpr int num_columns = 91, num_rows = 91;
constexpr int num_point_lookups = 60000, num_box_lookups = 2000;

struct Lattice : Program {
    Lattice() {
        for (int i = rank; i < num_columns * num_rows; i += num_ranks) {
            add({static_cast<double>(i % num_columns), static_cast<double>(i / num_columns)});
        }
        set("RETURN_LISTS", "PARTS");
        set("KEEP_CUTS", "1");
    }
    double* position(int i) { return &coordinates[2 * static_cast<std::size_t>(i % size())]; }
};

struct Findings {
    int num_lost = 0;  ///< points that a look-up finds in another part, over all ranks
    double point_seconds = 0, box_seconds = 0;
};

int count_lost(Lattice& lattice, const std::vector<int>& parts) {
    int num_lost = 0, rank = 0, part = 0;
    for (int i = 0; i < lattice.size(); ++i) {
        Zoltan_LB_Point_PP_Assign(lattice.zz, lattice.position(i), &rank, &part);
        if (part != parts[static_cast<std::size_t>(i)]) ++num_lost;
    }
    MPI_Allreduce(MPI_IN_PLACE, &num_lost, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return num_lost;
}

template <typename Body>
double fastest_of_many(Body body) {
    double fastest = 1e9;
    for (int repeat = 0; repeat < 25; ++repeat) {
        const double start = MPI_Wtime();
        body();
        fastest = std::min(fastest, MPI_Wtime() - start);
    }
    return fastest;
}

void look_up_points(Lattice& lattice) {
    int rank = 0, part = 0;
    for (int i = 0; i < num_point_lookups; ++i) {
        Zoltan_LB_Point_PP_Assign(lattice.zz, lattice.position(i), &rank, &part);
    }
}

void look_up_boxes(Lattice& lattice) {
    std::vector<int> ranks(static_cast<std::size_t>(lattice.num_ranks)), parts(ranks);
    int num_found_ranks = 0, num_found_parts = 0;
    for (int i = 0; i < num_box_lookups; ++i) {
        const double* x = lattice.position(i);
        Zoltan_LB_Box_PP_Assign(lattice.zz, x[0], x[1], 0, x[0] + 9, x[1] + 9, 0, ranks.data(),
                                &num_found_ranks, parts.data(), &num_found_parts);
    }
}

Findings examine(const char* method) {
    Lattice lattice;
    lattice.set("LB_METHOD", method);
    const Outcome outcome = lattice.partition();
    Findings findings;
    findings.num_lost = count_lost(lattice, outcome.exports.parts);
    findings.point_seconds = fastest_of_many([&] { look_up_points(lattice); });
    findings.box_seconds = fastest_of_many([&] { look_up_boxes(lattice); });
    if (lattice.rank == 0) {
        std::printf("%-4s %4d of %d points lie in another part; %.2f ms, %.2f ms\n", method,
                    findings.num_lost, num_columns * num_rows, 1e3 * findings.point_seconds,
                    1e3 * findings.box_seconds);
    }
    return findings;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    if (Program().rank == 0) {
        std::printf("look-ups on a lattice, and the time of %d of points, %d of boxes:\n",
                    num_point_lookups, num_box_lookups);
    }
    const Findings zoltan = examine("RCB");
    const Findings rrcb = examine("RRCB");
    MPI_Finalize();
    return zoltan.num_lost > 0 && rrcb.num_lost == 0 ? 0 : 1;
}
