"""Deliberate faults: a text of a file, what it becomes, and the test programs that must notice."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutation:
    name: str
    file: str
    text: str  # occurs once in the file
    instead: str
    programs: tuple[str, ...]


MUTATIONS = [
    Mutation(
        "a flipped comparison: points on a plane are below it",
        "src/cuts/packed_tree.cpp",
        "x0[i] >= p0 ? above : below",
        "x0[i] > p0 ? above : below",
        ("unit_direct_assignment", "properties.balance"),
    ),
    Mutation(
        "a flipped comparison: ties are broken downwards",
        "src/cuts/cuts.cpp",
        "position[a] != cut.at[a]) return position[a] > cut.at[a];",
        "position[a] != cut.at[a]) return position[a] < cut.at[a];",
        ("unit_cuts",),
    ),
    Mutation(
        "the wrong corner of a box",
        "src/cuts/tree.hpp",
        "is_above(cut, box.upper, dimension)};",
        "is_above(cut, box.lower, dimension)};",
        ("unit_cuts",),
    ),
    Mutation(
        "a dropped weight in the second moment",
        "src/passes/binned_points.cpp",
        "cell.second[a] += moment[a] * x[a];",
        "cell.second[a] += x[a] * x[a];",
        ("unit_moments",),
    ),
    Mutation(
        "an outlier that comes first stays the origin of its cell",
        "src/passes/moments.cpp",
        "most_variances = 16;",
        "most_variances = 1e300;",
        ("unit_moments", "unit_moments_accuracy"),
    ),
    Mutation(
        "a dropped weight in the second moment, summed again",
        "src/passes/moments.cpp",
        "sum.second[a] += w * d * d;",
        "sum.second[a] += d * d;",
        ("unit_moments",),
    ),
    Mutation(
        "a dropped correction of the rounded mean",
        "src/passes/moments.cpp",
        "sums.second[a] / weight - rest * rest",
        "sums.second[a] / weight",
        ("unit_moments", "unit_moments_accuracy"),
    ),
    Mutation(
        "a missing merge term: the distance of the means",
        "src/passes/moments.cpp",
        "2 * std::sqrt(share_a * share_b) * half_distance",
        "0 * half_distance",
        ("unit_moments",),
    ),
    Mutation(
        "the weights of the other set in the merged mean",
        "src/passes/moments.cpp",
        "a + share_b * (b - a)",
        "a + share_a * (b - a)",
        ("unit_moments",),
    ),
    Mutation(
        "a wrong half-width of the uniform density",
        "src/gather/cell_records.cpp",
        "std::sqrt(3.0) * moments",
        "std::sqrt(2.0) * moments",
        ("unit_statistical_domain", "unit_cell_records", "unit_contribution"),
    ),
    Mutation(
        "points beyond the last cell of the mesh",
        "src/passes/support_mesh.cpp",
        "0.0, mesh.cells[a] - 1.0)",
        "0.0, mesh.cells[a] - 0.0)",
        ("unit_support_mesh",),
    ),
    Mutation(
        "a patch that is divided keeps its weight above",
        "src/bisection/slice.cpp",
        "above.weight -= below.weight;",
        "",
        ("unit_bisection",),
    ),
    Mutation(
        "sizes of parts are ignored",
        "src/bisection/bisection.cpp",
        "return all > 0 ? below / all : 0;",
        "return all > 0 ? 0.5 : 0;",
        ("unit_bisection", "properties.balance"),
    ),
    Mutation(
        "the farther of two edges of a bin",
        "src/search/cut_search.cpp",
        "finish(search, best == 0 ? search.lower : search.upper, division.below);",
        "finish(search, best != 0 ? search.lower : search.upper, division.below);",
        ("mpi_refinement", "properties.balance"),
    ),
    Mutation(
        "the refinement counts points, not weights",
        "src/passes/count.cpp",
        "weights[slot] += points.weight(i);",
        "weights[slot] += 1;",
        ("mpi_refinement", "properties.balance"),
    ),
    Mutation(
        "a rank that has failed does not say so with its records",
        "src/collective/butterfly_mpi.cpp",
        "if (self.failed()) flags = joined(flags, failed_flags(butterfly, self));",
        "",
        ("faults.failing_memory", "mpi_butterfly"),
    ),
    Mutation(
        "rank 0 does not tell the others of a failure that it heard of",
        "src/collective/butterfly_mpi.cpp",
        "joined(flags, {butterfly.flags()[0]})",
        "flags",
        ("faults.failing_memory", "mpi_butterfly"),
    ),
    Mutation(
        "load unbalance forgets its sign",
        "src/lists/quality.cpp",
        "std::max(worst, std::abs(lu))",
        "std::max(worst, lu)",
        ("unit_quality",),
    ),
    Mutation(
        "points that stay are sent, points that leave are not",
        "src/lists/plan_mpi.cpp",
        "if (destination == rank) continue;",
        "if (destination != rank) continue;",
        ("mpi_plan",),
    ),
    Mutation(
        "counts for one rank replace each other on their way",
        "src/collective/rank_counts.cpp",
        "word_of(count_of(a) + count_of(b))",
        "word_of(count_of(b))",
        ("unit_rank_counts", "mpi_rank_counts"),
    ),
    Mutation(
        "many ranks are sorted by the lowest digit alone",
        "src/collective/rank_order.cpp",
        "shift += digit_bits",
        "shift += 0",
        ("unit_rank_order",),
    ),
    Mutation(
        "numbers of parts that lose most are chosen",
        "src/lists/number_search.cpp",
        "return std::tie(b.count, b.keeps, a.origin) < std::tie(a.count, a.keeps, b.origin);",
        "return std::tie(a.count, b.keeps, a.origin) < std::tie(b.count, a.keeps, b.origin);",
        ("unit_number_search",),
    ),
    Mutation(
        "infinite weights are let in",
        "src/passes/summary.cpp",
        "if (summary.lightest < 0 || !std::isfinite(extent.weight)) reject_weights(points);",
        "if (summary.lightest < 0) reject_weights(points);",
        ("mpi_agreement",),
    ),
    Mutation(
        "a flag in a buffer may be anything",
        "src/zoltan/handle/serialization.cpp",
        "if (byte > 1) refuse",
        "if (byte > 255) refuse",
        ("zoltan.serialization",),
    ),
    Mutation(
        "a piece begins in a place that is still in use",
        "src/collective/stream_mpi.hpp",
        "num_begun - num_ended < requests.size();",
        "num_begun - num_ended <= requests.size();",
        ("mpi_transfer",),
    ),
    Mutation(
        "pieces lie one place too far apart for the limit",
        "src/collective/stream_mpi.cpp",
        "num_places = lane_bytes_ / longest;",
        "num_places = lane_bytes_ / longest + 1;",
        ("mpi_transfer",),
    ),
    Mutation(
        "a point that leaves is kept as well",
        "src/lists/delivery_mpi.cpp",
        "begin = index + 1;",
        "begin = index;",
        ("mpi_transfer",),
    ),
    Mutation(
        "points that come overwrite those that stay",
        "src/lists/delivery_mpi.cpp",
        "(delivery.num_kept + first) * lane.bytes",
        "first * lane.bytes",
        ("mpi_transfer",),
    ),
    Mutation(
        "what ranks send is not compared with what is expected",
        "src/lists/delivery_mpi.cpp",
        "if (rank == none.rank) return;",
        "return;",
        ("mpi_transfer",),
    ),
    Mutation(
        "points of a column go in the order of the list, not of the ranks",
        "src/lists/transfer_mpi.cpp",
        "sorted[place] = plan.export_indices[k];",
        "sorted[k] = plan.export_indices[k];",
        ("mpi_transfer",),
    ),
    Mutation(
        "parts at exactly the radius do not count",
        "src/cuts/ball_search.hpp",
        "apart[a] > reach_",
        "apart[a] >= reach_",
        ("unit_ball_search", "mpi_ghosts"),
    ),
    Mutation(
        "a part at the radius is lost by rounding",
        "src/cuts/ball_search.hpp",
        "radius * (1 + 4 * epsilon)",
        "radius * (1 - 4 * epsilon)",
        ("unit_ball_search",),
    ),
    Mutation(
        "a ball that touches a side of a box is inside",
        "src/cuts/ball_search.hpp",
        "box.upper[a] - centre_[a] > reach_",
        "box.upper[a] - centre_[a] >= 0",
        ("unit_ball_search", "mpi_ghosts"),
    ),
    Mutation(
        "distances along the axes are not added up",
        "src/cuts/ball_search.hpp",
        "Vector above = apart;",
        "Vector above{};",
        ("unit_ball_search",),
    ),
    Mutation(
        "points of a shared part are not sent",
        "src/lists/ghosts_mpi.cpp",
        "ranks.first_rank != rank || ranks.count > 1",
        "ranks.first_rank != rank",
        ("mpi_ghosts",),
    ),
    Mutation(
        "a ghost is sent to a rank once for each of its parts",
        "src/lists/ghosts_mpi.cpp",
        "ranks_.erase(std::unique(ranks_.begin() + first, ranks_.end()), ranks_.end());",
        "",
        ("mpi_ghosts",),
    ),
    Mutation(
        "the places of points with great radii are not noted",
        "src/cuts/ball_search.hpp",
        "const bool is_great = radius > of(end) / 2;",
        "const bool is_great = false;",
        ("mpi_ghosts_needs",),
    ),
    Mutation(
        "cuts that a rank lacks are not asked for",
        "src/cuts/ball_search.hpp",
        "if (is_unknown(entry)) return lack(unknown_node(entry));",
        "if (is_unknown(entry)) return;",
        ("mpi_spread_ghosts",),
    ),
]
