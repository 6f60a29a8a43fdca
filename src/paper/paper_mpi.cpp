#include "paper/paper_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stamp_access.hpp"
#include "estimate/cell_records.hpp"
#include "estimate/decision_mpi.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"
#include "paper/paper_words.hpp"
#include "paper/point_selection.hpp"

#include <rrcb/detail/support_mesh.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace rrcb {

namespace {

bool has(const Choice& words, int value) {
    return std::ranges::find(words, value, &Word::value) != words.end();
}

void check(const PaperOptions& options, int dimension) {
    const int most_cells = dimension < 3 ? 4096 : 256;
    require(options.num_parts >= 1, "num_parts must be positive, or 0 for one part per rank");
    require(options.cells_per_axis >= 1 && options.cells_per_axis <= most_cells,
            "cells_per_axis must be 1 ... 4096 cells per axis, in 3-D 1 ... 256");
    require(options.sample_fraction > 0 && options.sample_fraction <= 1,
            "sample_fraction must be in (0, 1]");
    check_sampling(options);
    check_sizes(options.num_parts, options.part_sizes);
    require(has(domain_words, static_cast<int>(options.domain)),
            "domain must be one of PaperDomain");
    require(has(cut_rule_words, static_cast<int>(options.cut_rule)),
            "cut_rule must be one of CutRule");
}

/// Throws the same Error on all ranks if one has failed, or if options differ. Collective.
void agree_on(const PaperOptions& options, const Points& points, Participant& self) {
    agree(self, {{"dimension", static_cast<std::uint64_t>(points.dimension)},
                 weights_given(points),
                 {"num_parts", static_cast<std::uint64_t>(options.num_parts)},
                 {"part_sizes", hash_of(options.part_sizes)},
                 {"domain", static_cast<std::uint64_t>(options.domain)},
                 {"cut_rule", static_cast<std::uint64_t>(options.cut_rule)},
                 {"plain_cuts", options.plain_cuts ? 1u : 0u},
                 {"cells_per_axis", static_cast<std::uint64_t>(options.cells_per_axis)},
                 {"sigma_multiplier", std::bit_cast<std::uint64_t>(options.sigma_multiplier)},
                 {"sample_fraction", std::bit_cast<std::uint64_t>(options.sample_fraction)},
                 {"seed", options.seed},
                 {name_of_arithmetic, arithmetic_in_use()}});
}

/// Step 1: reduces this rank's points to the moments of cells. The paper's RCB keeps the points.
Contribution reduce_points(const Points& points, const Box& box, const PaperOptions& options,
                           int rank) {
    PointSummary totals{points.count};
    for (LocalIndex i = 0; i < points.count; ++i) {
        totals.weight += points.weight(i);
        totals.lightest = std::min(totals.lightest, points.weight(i));
        totals.heaviest = std::max(totals.heaviest, points.weight(i));
    }
    Contribution mine{summarize(totals, !points.weights.empty(), rank), {}};
    if (options.domain == PaperDomain::points) {
        for (LocalIndex i = 0; i < points.count; ++i) {
            append_vector(points.position(i), points.dimension, mine.records);
            mine.records.push_back(points.weight(i));
        }
        mine.summary.num_cells = mine.summary.num_points;
    } else if (points.count > 0) {
        const CellSet set{
            cell_moments(points, make_support_mesh(box, points.dimension, options.cells_per_axis)),
            0};
        append_cells(set, points.dimension, 1, mine.records);
        mine.summary.num_cells = std::ssize(set.cells);
    }
    return mine;
}

/// Step 2: gathers the cells or points of all ranks on rank 0. Collective.
void gather(Contribution& mine, int dimension, Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    merge_up(mine, dimension, {num_ranks, num_ranks}, std::numeric_limits<std::size_t>::max(),
             self);
}

/// Step 3, on rank 0: makes the statistical domain, from random points or from the real ones.
std::vector<MassPoint> make_domain(const Contribution& all, int dimension,
                                   const PaperOptions& options) {
    std::span<const double> records(all.records);
    if (options.domain == PaperDomain::sampled)
        return sample_points(read_cells(records, dimension, true).cells, dimension, options);
    std::vector<MassPoint> domain;
    while (!records.empty()) {
        const Vector position = take_vector(records, dimension);
        const double weight = take(records, 1)[0];
        domain.push_back({position, all.summary.weight > 0 ? weight : 1.0});
    }
    return domain;
}

/// Step 4, on rank 0: bisects the domain.
void bisect_domain(const Contribution& all, const PaperOptions& options,
                   std::span<const double> part_sizes, Decision& decision) {
    check_together(all.summary);
    const int dimension = decision.cuts.dimension;
    Bisection made =
        bisect_points(make_domain(all, dimension, options), dimension, options.num_parts,
                      part_sizes, options.cut_rule, options.plain_cuts);
    decision.cuts = std::move(made.cuts);
    decision.verdict = verdict_of(all.summary, made.part_weights, part_sizes);
}

}  // namespace

Balance balance_as_in_paper(const Points& points, MPI_Comm comm, const PaperOptions& options) {
    Participant self = mpi::enter(comm, CallName::balance_as_in_paper);
    return balance_as_in_paper(points, options, self);
}

Balance balance_as_in_paper(const Points& points, const PaperOptions& given, Participant& self) {
    PaperOptions options;
    Options plain;
    Balance result;
    Contribution mine;
    Decision decision;
    self.attempt([&] {
        options = given;
        if (options.num_parts == 0) options.num_parts = mpi::size_of(self.comm);
        const Box box = check_points(points);
        check(options, points.dimension);
        mine = reduce_points(points, box, options, mpi::rank_of(self.comm));
        plain.part_sizes = options.part_sizes;
        normalize(plain.part_sizes, options.num_parts);
        plain.refine = Refine::none;
        make_buffers(decision, plain, points.dimension, false);
        result.parts.resize(points.count);
    });
    agree_on(options, points, self);
    gather(mine, points.dimension, self);
    // Step 5: every rank gets the cuts.
    decide_together(mine, decision, self,
                    [&] { bisect_domain(mine, options, plain.part_sizes, decision); });
    result.report = report_of(decision.verdict, options.num_parts, plain.part_sizes);
    result.cuts = std::move(decision.cuts);
    detail::StampAccess::ranks(result.cuts.stamp) = mpi::size_of(self.comm) > 1 ? self.group() : 0;
    self.attempt([&] {
        assign(result.cuts, points, result.parts);
        detail::StampAccess::points(result.cuts.stamp) =
            hash_if_leaving(points, result.parts, options.num_parts, mpi::rank_of(self.comm),
                            mpi::size_of(self.comm));
    });
    agree(self);
    return result;
}

}  // namespace rrcb
