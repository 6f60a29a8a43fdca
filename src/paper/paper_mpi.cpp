#include "paper/paper_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stage_scope.hpp"
#include "estimate/decision_mpi.hpp"
#include "estimate/merge_tree_mpi.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"
#include "paper/paper_records.hpp"
#include "paper/paper_words.hpp"
#include "paper/point_selection.hpp"

#include <rrcb/method/support_mesh.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <bit>
#include <utility>

namespace rrcb {

namespace {

bool has(const Choice& words, int value) {
    return std::ranges::find(words, value, &Word::value) != words.end();
}

void check(const PaperOptions& options, int dimension) {
    const int most_cells = dimension < 3 ? 4096 : 256;
    require(options.num_parts >= 1, "num_parts must be positive, or 0 for one part per rank");
    require(options.support_mesh >= 1 && options.support_mesh <= most_cells,
            "support_mesh must be 1 ... 4096 cells per axis, in 3-D 1 ... 256");
    require(options.sample_fraction > 0 && options.sample_fraction <= 1,
            "sample_fraction must be in (0, 1]");
    check_sampling(options);
    check_sizes(options.num_parts, options.part_sizes);
    require(has(domain_words, static_cast<int>(options.domain)),
            "domain must be one of PaperDomain");
    require(has(cut_rule_words, static_cast<int>(options.cut_rule)),
            "cut_rule must be one of CutRule");
}

/// Throws on all ranks if one has failed, or if their options differ. Collective.
void agree_on(const PaperOptions& options, const Points& points, Participant& self) {
    agree(self, {{"dimension", static_cast<std::uint64_t>(points.dimension)},
                 weights_given(points),
                 {"num_parts", static_cast<std::uint64_t>(options.num_parts)},
                 {"part_sizes", hash_of(options.part_sizes)},
                 {"domain", static_cast<std::uint64_t>(options.domain)},
                 {"cut_rule", static_cast<std::uint64_t>(options.cut_rule)},
                 {"plain_cuts", options.plain_cuts ? 1u : 0u},
                 {"support_mesh", static_cast<std::uint64_t>(options.support_mesh)},
                 {"sigma_multiplier", std::bit_cast<std::uint64_t>(options.sigma_multiplier)},
                 {"sample_fraction", std::bit_cast<std::uint64_t>(options.sample_fraction)},
                 {"seed", options.seed},
                 {name_of_arithmetic, arithmetic_in_use()}});
}

/// Step 1: reduces the local points to the moments of cells; the paper's RCB keeps the points.
std::vector<double> reduce_points(const Points& points, const Box& box,
                                  const PaperOptions& options) {
    if (options.domain == PaperDomain::points) return pack_points(points);
    std::vector<CellMoments> cells;
    if (points.count > 0)
        cells =
            cell_moments(points, make_support_mesh(box, points.dimension, options.support_mesh));
    return pack_moments(points, cells);
}

/// Step 2: gathers the cells or points of all ranks on rank 0. Collective.
void gather(std::vector<double>& packed, StageObserver* observer, Participant& self) {
    const StageScope stage(observer, Stage::gather, self.arithmetic);
    gather_records(packed, self);
}

/// Returns the report of a bisection, on rank 0.
Verdict verdict_of(const PaperRecords& all, std::span<const double> part_weights,
                   const PaperOptions& options) {
    Verdict verdict;
    verdict.num_points = all.num_points;
    verdict.num_records =
        options.domain == PaperDomain::sampled ? std::ssize(all.cells) : all.num_points;
    verdict.total_weight = all.weight;
    verdict.estimated_imbalance = imbalance(part_weights, options.part_sizes);
    verdict.heaviest = all.weight == 0 ? 1 : all.heaviest;
    return verdict;
}

/// Steps 3 and 4, on rank 0: makes the statistical domain, of random points or the real ones, and
/// bisects it.
Verdict bisect_domain(std::span<const double> packed, PaperOptions options, Cuts& cuts) {
    normalize(options.part_sizes, options.num_parts);
    const int dimension = cuts.dimension;
    const bool draws = options.domain == PaperDomain::sampled;
    const PaperRecords all =
        draws ? unpack_moments(packed, dimension) : unpack_points(packed, dimension);
    std::vector<MassPoint> domain =
        draws ? sample_points(all.cells, dimension, options)
              : mass_points(interleaved_points(all.coordinates, dimension, all.weights));
    Bisection bisection = bisect_points(std::move(domain), dimension, options.num_parts,
                                        options.part_sizes, options.cut_rule, options.plain_cuts);
    cuts.tree = std::move(bisection.cuts.tree);
    return verdict_of(all, bisection.part_weights, options);
}

/// Step 5: sends the cuts to every rank, or throws the error of one rank on all. Collective.
void broadcast(Verdict& verdict, std::vector<Cut>& tree, StageObserver* observer,
               Participant& self) {
    const StageScope stage(observer, Stage::broadcast, self.arithmetic);
    if (mpi::rank_of(self.comm) == root) verdict.failing_rank = self.failing_rank();
    mpi::broadcast(std::as_writable_bytes(std::span(&verdict, 1)), root, self.comm);
    fail_together(verdict.failing_rank, self);
    mpi::broadcast(std::as_writable_bytes(std::span(tree)), root, self.comm);
}

}  // namespace

Balance balance_as_in_paper(const Points& points, const PaperOptions& options, MPI_Comm comm) {
    Participant self = mpi::enter(comm, CallName::balance_as_in_paper);
    return balance_as_in_paper(points, options, self);
}

Balance balance_as_in_paper(const Points& points, const PaperOptions& given, Participant& self) {
    PaperOptions options;
    Balance result;
    std::vector<double> packed;
    self.attempt([&] {
        const StageScope stage(given.observer, Stage::moments, self.arithmetic);
        options = given;
        if (options.num_parts == 0) options.num_parts = mpi::size_of(self.comm);
        const Box box = check_points(points);
        check(options, points.dimension);
        packed = reduce_points(points, box, options);
        result.cuts = {points.dimension, options.num_parts, {}};
        result.cuts.group = mpi::size_of(self.comm) > 1 ? mpi::group_of(self.comm) : 0;
        result.cuts.points = hash_of(points);
        result.cuts.tree.resize(static_cast<std::size_t>(options.num_parts) - 1);
        result.parts.resize(points.count);
    });
    agree_on(options, points, self);
    if (!options.part_sizes.empty()) normalize(options.part_sizes, options.num_parts);
    gather(packed, options.observer, self);
    Verdict verdict;
    if (mpi::rank_of(self.comm) == root)
        self.attempt([&] {
            const StageScope stage(options.observer, Stage::bisection, self.arithmetic);
            verdict = bisect_domain(packed, options, result.cuts);
        });
    broadcast(verdict, result.cuts.tree, options.observer, self);
    result.report = report_of(verdict, options.num_parts, options.part_sizes);
    const StageScope stage(options.observer, Stage::assignment, self.arithmetic);
    self.attempt([&] { assign(result.cuts, points, result.parts); });
    agree(self);
    return result;
}

}  // namespace rrcb
