// Calls the class RCB as LAMMPS' Balance does, with examples/lammps loaded before.
#include "../support/common.hpp"
#include "lammps_original.hpp"

#include <cstdlib>

namespace {

struct CutOfRank {
    double cut;
    int axis;
};

struct Atoms {
    std::vector<double> coordinates;
    std::vector<double*> rows;
    double lower[3] = {0, 0, 0}, upper[3] = {4, 2, 1};

    Atoms(int rank, int count) {
        std::mt19937 random(rank + 1);
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int i = 0; i < count; ++i)
            for (const double size : upper) coordinates.push_back(size * uniform(random));
        for (int i = 0; i < count; ++i) rows.push_back(&coordinates[3 * i]);
    }
};

class Lammps : public ::testing::Test {
  protected:
    void SetUp() override {
        MPI_Comm_rank(world, &rank);
        MPI_Comm_size(world, &num_ranks);
    }

    void balance(LAMMPS_NS::RCB& rcb, Atoms& atoms) {
        rcb.compute(3, static_cast<int>(atoms.rows.size()), atoms.rows.data(), nullptr, atoms.lower,
                    atoms.upper);
        rcb.invert();
    }

    /// Walks as LAMMPS' CommTiled does.
    int owner_of(const std::vector<CutOfRank>& cuts, const double* x) const {
        int first = 0, last = num_ranks - 1;
        while (first < last) {
            const int middle = first + (last - first) / 2 + 1;
            if (x[cuts[middle].axis] < cuts[middle].cut)
                last = middle - 1;
            else
                first = middle;
        }
        return first;
    }

    void expect_consistent(const LAMMPS_NS::RCB& rcb, const Atoms& atoms) const {
        std::vector<CutOfRank> cuts(num_ranks);
        const CutOfRank mine{rcb.cut, rcb.cutdim};
        MPI_Allgather(&mine, sizeof mine, MPI_BYTE, cuts.data(), sizeof mine, MPI_BYTE, world);
        std::vector<double> boxes(6 * num_ranks);
        double box[6];
        std::copy(rcb.hi, rcb.hi + 3, std::copy(rcb.lo, rcb.lo + 3, box));
        MPI_Allgather(box, 6, MPI_DOUBLE, boxes.data(), 6, MPI_DOUBLE, world);
        std::vector<int> loads(num_ranks);
        for (std::size_t i = 0; i < atoms.rows.size(); ++i) {
            const double* const x = atoms.rows[i];
            const int owner = rcb.sendproc[i];
            ASSERT_EQ(owner, owner_of(cuts, x));
            ++loads[owner];
            for (int a = 0; a < 3; ++a) {
                EXPECT_GE(x[a], boxes[6 * owner + a]);
                EXPECT_LE(x[a], boxes[6 * owner + 3 + a]);
            }
        }
        EXPECT_EQ(cuts[0].axis, -1);
        MPI_Allreduce(MPI_IN_PLACE, loads.data(), num_ranks, MPI_INT, MPI_SUM, world);
        const int total = std::accumulate(loads.begin(), loads.end(), 0);
        EXPECT_LE(*std::max_element(loads.begin(), loads.end()), 1.011 * total / num_ranks + 1);
    }

    MPI_Comm world = MPI_COMM_WORLD;
    int rank = 0, num_ranks = 1;
};

TEST_F(Lammps, makes_parts_as_lammps_looks_them_up) {
    const auto allocated = std::make_unique<LAMMPS_NS::RCB>(world);
    LAMMPS_NS::RCB& rcb = *allocated;
    Atoms atoms(rank, 2000 * (rank + 1));
    balance(rcb, atoms);
    expect_consistent(rcb, atoms);
}

TEST_F(Lammps, serves_ranks_without_atoms_and_later_calls) {
    const auto allocated = std::make_unique<LAMMPS_NS::RCB>(world);
    LAMMPS_NS::RCB& rcb = *allocated;
    for (const int count : {rank == 0 ? 4000 : 0, 3000, rank + 1 == num_ranks ? 9000 : 0}) {
        Atoms atoms(rank, count);
        balance(rcb, atoms);
        expect_consistent(rcb, atoms);
    }
}

TEST_F(Lammps, leaves_what_has_no_solution_to_lammps) {
    setenv("RRCB_MIN_WIDTH", "10", 1);
    const auto allocated = std::make_unique<LAMMPS_NS::RCB>(world);
    LAMMPS_NS::RCB& rcb = *allocated;
    Atoms atoms(rank, 1000);
    balance(rcb, atoms);
    unsetenv("RRCB_MIN_WIDTH");
    expect_consistent(rcb, atoms);
    balance(rcb, atoms);
    expect_consistent(rcb, atoms);
}

}  // namespace
