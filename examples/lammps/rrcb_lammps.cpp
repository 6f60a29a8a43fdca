// This library is preloaded into LAMMPS and computes the parts of `balance ... rcb` and `fix
// balance ... rcb`; README.md describes its use. As LAMMPS expects, the parts have the numbers of
// the ranks in ascending order, and of an odd number of ranks the larger half is below the cut.
#include "lammps_rcb.hpp"

#include <rrcb/rrcb.hpp>
#include <rrcb/version.hpp>

#include <dlfcn.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>

namespace {

using LAMMPS_NS::RCB;

/// Calls LAMMPS' own function of the class, found by its symbol.
template <class... Arguments>
void call_original(const char* symbol, RCB* rcb, Arguments... arguments) {
    void* const function = dlsym(RTLD_NEXT, symbol);
    if (function == nullptr) {
        std::fprintf(stderr, "RRCB: LAMMPS' functions are not found: %s\n", dlerror());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    reinterpret_cast<void (*)(RCB*, Arguments...)>(function)(rcb, arguments...);
}

void original_compute(RCB* rcb, int dimension, int n, double** x, double* weights, double* lower,
                      double* upper) {
    call_original("_ZN9LAMMPS_NS3RCB7computeEiiPPdS1_S1_S1_", rcb, dimension, n, x, weights, lower,
                  upper);
}

void original_invert(RCB* rcb, int sort) {
    call_original("_ZN9LAMMPS_NS3RCB6invertEi", rcb, sort);
}

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0' && std::string(value) != "0";
}

/// Returns true on the first process of a program that used MPI. It reads the launcher's
/// environment, because MPI has been finalized when it is called.
bool is_first_of_mpi() {
    int initialized = 0;
    MPI_Initialized(&initialized);
    if (!initialized) return false;
    for (const char* name : {"PMIX_RANK", "OMPI_COMM_WORLD_RANK", "PMI_RANK"})
        if (const char* const rank = std::getenv(name)) return std::string(rank) == "0";
    return true;
}

/// The state that is kept between the calls of a process.
struct Session {
    std::optional<bool> active;  // whether RRCB computes the parts; the ranks agree on it in the
                                 // first call
    bool verbose = false;        // agreed in the first call as well
    bool answered = false;       // whether RRCB computed the latest parts
    bool noticed = false;        // whether a message has said that LAMMPS computes the parts
    int rank = -1;
    std::map<MPI_Comm, rrcb::Balance> balances;
    long long calls = 0, answers = 0;
    double seconds = 0;
    double atoms = 0, moved = 0;  // on all ranks, if verbose

    ~Session() {
        if (!active && is_set("RRCB_VERBOSE") && is_first_of_mpi())
            std::fprintf(stderr, "RRCB %s: no calls\n", rrcb::version());
        if (!verbose || rank != 0) return;
        std::fprintf(stderr,
                     "RRCB answered %lld of %lld calls: %.6f s, %.4f %% of the atoms moved\n",
                     answers, calls, seconds, atoms > 0 ? 100 * moved / atoms : 0.0);
    }
};

Session session;

void notice(const std::string& reason) {
    if (session.rank == 0 && !session.noticed)
        std::fprintf(stderr, "RRCB leaves the call to LAMMPS: %s\n", reason.c_str());
    session.noticed = true;
}

/// Returns true if LAMMPS' allocation of the object is large enough, and if the members that a
/// wrong layout would make unusable have sensible values. Not collective.
bool looks_like_rcb(RCB& rcb) {
    int all = 0, size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &all);
    if (malloc_usable_size(&rcb) < sizeof(RCB)) return false;
    if (rcb.nprocs < 1 || rcb.nprocs > all || rcb.me < 0 || rcb.me >= rcb.nprocs) return false;
    MPI_Comm_size(*rcb.world, &size);
    return size == rcb.nprocs;
}

/// Returns true if LAMMPS' own functions write a known result to the members where this layout
/// expects it. The test has one point per rank; the points are on a line, in the reverse order of
/// the ranks.
bool writes_known_answer(RCB& rcb) {
    double point[3] = {rcb.nprocs - rcb.me - 0.5, 0, 0};
    double* points[1] = {point};
    double lower[3] = {}, upper[3] = {static_cast<double>(rcb.nprocs), 0, 0};
    original_compute(&rcb, 2, 1, points, nullptr, lower, upper);
    original_invert(&rcb, 0);
    const bool has_cut =
        rcb.me == 0 ? rcb.cutdim == -1 : rcb.cutdim == 0 && std::abs(rcb.cut - rcb.me) <= 0.5;
    return rcb.noriginal == 1 && rcb.nfinal == 1 && rcb.maxsend == 1 && rcb.lo == rcb.box.lo &&
           rcb.hi == rcb.box.hi && has_cut && std::abs(rcb.lo[0] - rcb.me) <= 0.5 &&
           std::abs(rcb.hi[0] - rcb.me - 1) <= 0.5 && rcb.sendproc[0] == rcb.nprocs - 1 - rcb.me;
}

/// Makes all ranks agree on whether RRCB computes the parts in this process.
void agree(RCB& rcb) {
    if (!looks_like_rcb(rcb)) {
        MPI_Comm_rank(MPI_COMM_WORLD, &session.rank);
        session.active = false;
        notice("its class RCB has another layout");
        return;
    }
    session.rank = rcb.me;
    int flags[3] = {!writes_known_answer(rcb), is_set("RRCB_OFF"), is_set("RRCB_VERBOSE")};
    MPI_Allreduce(MPI_IN_PLACE, flags, 3, MPI_INT, MPI_MAX, *rcb.world);
    if (flags[0]) notice("its class RCB has another layout");
    session.active = !flags[0] && !flags[1];
    session.verbose = flags[2];
}

rrcb::Points points_of(int dimension, int n, double** x, const double* weights) {
    rrcb::Points points;
    points.dimension = dimension;
    points.count = static_cast<rrcb::LocalIndex>(n);
    points.stride = 3 * sizeof(double);
    if (n == 0) return points;
    for (int axis = 0; axis < dimension; ++axis) points.axes[axis] = x[0] + axis;
    if (weights != nullptr) points.weights = {weights, points.count};
    return points;
}

rrcb::Options options_of(int dimension) {
    rrcb::Options options{.expert = {.axes = {.plain = true}, .tree = {.larger_below = true}}};
    if (const char* text = std::getenv("RRCB_IMBALANCE_TOL"))
        options.imbalance_tolerance = std::strtod(text, nullptr);
    if (const char* text = std::getenv("RRCB_MIN_WIDTH")) {
        std::istringstream words(text);
        auto& widths = options.expert.axes.min_width;
        for (double width = 0; words >> width;) widths.push_back(width);
        if (widths.size() == 1) widths.assign(dimension, widths[0]);
    }
    return options;
}

/// Writes the box and the cut of this rank. `cut` is the first of the cuts that divide the ranks
/// from `first` to `last`. Returns false, on all ranks, if some box would be empty.
bool write_box(RCB& rcb, const rrcb::Cut*& cut, int first, int last, const rrcb::Box& box) {
    if (first == last) {
        if (first != rcb.me) return true;
        std::copy(box.lower.begin(), box.lower.end(), rcb.box.lo);
        std::copy(box.upper.begin(), box.upper.end(), rcb.box.hi);
        return true;
    }
    const int axis = cut->axis;
    const double at = cut->at[axis];
    const int middle = first + (last - first) / 2 + 1;
    if (!(box.lower[axis] < at && at < box.upper[axis])) return false;
    if (rcb.me == middle) {
        rcb.cut = at;
        rcb.cutdim = axis;
    }
    rrcb::Box below = box, above = box;
    below.upper[axis] = above.lower[axis] = at;
    ++cut;
    return write_box(rcb, cut, first, middle - 1, below) &&
           write_box(rcb, cut, middle, last, above);
}

/// Writes the rank of each point. LAMMPS frees the arrays with free().
void write_ranks(RCB& rcb, const std::vector<rrcb::Part>& parts) {
    const int n = static_cast<int>(parts.size());
    if (n > rcb.maxsend || rcb.sendproc == nullptr) {
        std::free(rcb.sendproc);
        std::free(rcb.sendindex);
        rcb.maxsend = std::max(n, 1);
        rcb.sendproc = static_cast<int*>(std::calloc(rcb.maxsend, sizeof(int)));
        rcb.sendindex = static_cast<int*>(std::calloc(rcb.maxsend, sizeof(int)));
        if (rcb.sendproc == nullptr || rcb.sendindex == nullptr) MPI_Abort(*rcb.world, 1);
    }
    std::copy(parts.begin(), parts.end(), rcb.sendproc);
}

/// Computes the parts. Returns false, on all ranks, if LAMMPS has to compute them instead.
bool answer(RCB& rcb, bool is_new, const rrcb::Points& points, const double* lower,
            const double* upper) try {
    rrcb::Balance& balance = session.balances[*rcb.world];
    const rrcb::Options options = options_of(points.dimension);
    rrcb::Cuts& cuts = balance.cuts;
    if (is_new || cuts.num_parts != rcb.nprocs || cuts.dimension != points.dimension) cuts = {};
    rrcb::balance_into(balance, points, *rcb.world, options, cuts);
    rrcb::Box box;
    std::copy(lower, lower + 3, box.lower.begin());
    std::copy(upper, upper + 3, box.upper.begin());
    rcb.cut = 0;
    rcb.cutdim = -1;
    const rrcb::Cut* cut = cuts.tree.data();
    if (!write_box(rcb, cut, 0, rcb.nprocs - 1, box)) {
        session.balances.erase(*rcb.world);
        notice("a box would be empty");
        return false;
    }
    rcb.lo = rcb.box.lo;
    rcb.hi = rcb.box.hi;
    rcb.noriginal = static_cast<int>(points.count);
    write_ranks(rcb, balance.parts);
    return true;
} catch (const rrcb::Error& error) {
    session.balances.erase(*rcb.world);
    notice(error.what());
    return false;
}

void count_moved(const RCB& rcb) {
    double counts[2] = {static_cast<double>(rcb.noriginal), 0}, sums[2] = {};
    counts[1] = counts[0] -
                static_cast<double>(std::count(rcb.sendproc, rcb.sendproc + rcb.noriginal, rcb.me));
    MPI_Reduce(counts, sums, 2, MPI_DOUBLE, MPI_SUM, 0, *rcb.world);
    session.atoms += sums[0];
    session.moved += sums[1];
}

}  // namespace

void RCB::compute(int dimension, int n, double** x, double* weights, double* lower, double* upper) {
    const bool is_new = sendproc == nullptr;
    if (!session.active) agree(*this);
    const double start = MPI_Wtime();
    session.answered =
        *session.active && answer(*this, is_new, points_of(dimension, n, x, weights), lower, upper);
    if (!session.answered) original_compute(this, dimension, n, x, weights, lower, upper);
    session.seconds += MPI_Wtime() - start;
    ++session.calls;
    session.answers += session.answered;
}

void RCB::invert(int sort) {
    const double start = MPI_Wtime();
    if (!session.answered) original_invert(this, sort);
    session.answered = false;
    session.seconds += MPI_Wtime() - start;
    if (session.verbose) count_moved(*this);
}
