#include "zoltan/norm/norm_balance_mpi.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/tree.hpp"
#include "zoltan/norm/loads_mpi.hpp"
#include "zoltan/norm/norm_level_mpi.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace rrcb::zoltan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Shares = std::array<double, most_weights>;

/// A node of the level that is cut next.
struct Node {
    Descent at;
    int depth = 0;
    NormObjects::Range range{};  ///< this rank's objects
    Load all{};                  ///< of all ranks
    std::size_t first_search = 0;
    std::size_t num_searches = 0;
    std::size_t middle = 0;  ///< in the range: where those above the cut begin
    const LevelSearch* chosen = nullptr;
    std::size_t lot = 0;  ///< number among those whose objects in one place are divided
};

/// Box of all objects. Collective.
Box box_of_all(const Points& points, MPI_Comm comm) {
    const Box mine = bounding_box(points);
    std::array<Vector, 2> ends{mine.lower, mine.upper};
    for (double& end : ends[0]) end = -end;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &ends, 6, MPI_DOUBLE, MPI_MAX, comm), "MPI_Allreduce");
    for (double& end : ends[0]) end = -end;
    return {ends[0], ends[1]};
}

std::size_t most_nodes(const Options& options) {
    return static_cast<std::size_t>(options.num_parts) / 2 + 1;
}

/// One call on one rank. Its constructor asks for all memory.
class NormBisection {
  public:
    NormBisection(const Points& points, const Criteria& criteria, const Options& options,
                  const Units& units, const Box& box)
        : points_(points),
          criteria_(criteria),
          options_(options),
          loads_(loads_of(criteria, units)),
          objects_(points, loads_),
          messages_(most_nodes(options) * static_cast<std::size_t>(points.dimension)),
          axis_of_(options, box, points.dimension),
          part_loads_(static_cast<std::size_t>(options.num_parts)),
          children_(2 * most_nodes(options)),
          units_(units) {
        nodes_.reserve(most_nodes(options));
        next_.reserve(most_nodes(options));
        searches_.reserve(most_nodes(options) * static_cast<std::size_t>(points.dimension));
        make_sizes();
    }

    /// Collective.
    void run(Balance& result, MPI_Comm comm) {
        Load all = objects_.sum(objects_.all());
        LevelMessages::add_up({&all, 1}, comm);
        value_units(all);
        nodes_.push_back({root_of(result.cuts), 0, objects_.all(), all});
        if (options_.num_parts == 1) finish_part(nodes_.back(), result);
        if (options_.num_parts == 1) nodes_.clear();
        result.report.rounds = 0;
        result.report.coincident_cuts = 0;
        while (!nodes_.empty()) {
            start_searches();
            result.report.rounds += messages_.run(searches_, objects_, comm);
            for (Node& node : nodes_) choose(node, result);
            divide_level(result, comm);
            descend(result, comm);
        }
        measure(all, result.report);
    }

  private:
    void value_units(const Load& all) {
        for (std::size_t k = 0; k < most_weights; ++k) {
            if (all[k] == 0) continue;
            values_[k] = 1 / (criteria_.comparable ? units_.per_weight[k] : double(all[k]));
        }
    }

    void make_sizes() {
        sizes_[0] = options_.part_sizes;
        for (std::size_t k = 0; k < criteria_.further_sizes.size(); ++k)
            sizes_[k + 1] = criteria_.further_sizes[k];
        for (std::vector<double>& sizes : sizes_)
            if (sizes.empty()) sizes.assign(static_cast<std::size_t>(options_.num_parts), 1.0);
    }

    /// Share of each weight that belongs below.
    Shares shares_of(const Descent& at) const {
        const std::size_t num_weights =
            std::min(criteria_.stride, static_cast<std::size_t>(most_weights));
        Shares shares{};
        for (std::size_t k = 0; k < shares.size(); ++k)
            shares[k] = share_below(std::span(sizes_[k < num_weights ? k : 0])
                                        .subspan(static_cast<std::size_t>(at.first_part),
                                                 static_cast<std::size_t>(at.num_parts)));
        return shares;
    }

    /// Whether a node is searched: not without objects, nor with all of them on one side.
    static bool is_searched(const Node& node, const Shares& shares) {
        const bool any_below = std::ranges::any_of(shares, [](double share) { return share > 0; });
        const bool any_above = std::ranges::any_of(shares, [](double share) { return share < 1; });
        return node.all[most_weights] > 0 && any_below && any_above;
    }

    void start_searches() {
        searches_.clear();
        for (Node& node : nodes_) {
            node.first_search = searches_.size();
            const Shares shares = shares_of(node.at);
            if (is_searched(node, shares)) {
                const Aim aim = aim_of(criteria_.norm, values_, shares, node.all);
                const bool is_free = options_.cut_axes.empty() && options_.grouped_axes.empty();
                const int given = is_free ? -1 : axis_of_(node.at.node, node.depth, Box{});
                for (int axis = 0; axis < points_.dimension; ++axis)
                    if (is_free || axis == given) start_search(node, axis, aim);
            }
            node.num_searches = searches_.size() - node.first_search;
        }
    }

    void start_search(const Node& node, int axis, const Aim& aim) {
        const int num_axes = options_.plain_cuts ? 1 : points_.dimension;
        searches_.push_back(
            {NormSearch(axis, num_axes, aim), node.range, objects_.list(node.range, axis)});
    }

    /// Chooses the best search of a node, of those across axes that are long enough.
    void choose(Node& node, Balance& result) {
        Cut& cut = result.cuts.tree[node.at.node];
        if (node.num_searches == 0) {
            cut = {0, 0, {-infinity, -infinity, -infinity}};
            if (std::ranges::min(shares_of(node.at)) >= 1) cut.at[0] = infinity;
            return;
        }
        const std::span searches =
            std::span(searches_).subspan(node.first_search, node.num_searches);
        double longest = 0;
        for (const LevelSearch& s : searches) longest = std::max(longest, s.search.half_extent());
        const auto is_long = [&](const LevelSearch& s) {
            return s.search.half_extent() >= longest / criteria_.max_aspect_ratio;
        };
        double best = infinity;
        for (const LevelSearch& s : searches)
            if (is_long(s)) best = std::min(best, s.search.quality());
        const double enough = best * (1 + slack());
        for (const LevelSearch& s : searches) {
            if (!is_long(s) || s.search.quality() > enough) continue;
            if (node.chosen == nullptr ||
                s.search.half_extent() > node.chosen->search.half_extent())
                node.chosen = &s;
        }
        cut = node.chosen->search.cut();
        if (is_coincident(*node.chosen)) ++result.report.coincident_cuts;
    }

    /// Imbalance that a level may add.
    double slack() const {
        const int levels = std::bit_width(static_cast<unsigned>(options_.num_parts - 1));
        return (options_.imbalance_tolerance - 1) / levels;
    }

    bool is_coincident(const LevelSearch& s) const { return s.search.meets_one_place(); }

    bool is_divided(const Node& node) const {
        return node.chosen != nullptr && is_coincident(*node.chosen) && !options_.plain_cuts &&
               options_.coincident == Coincident::divide;
    }

    /// Divides the objects of each node. Of those in one place the lower ranks' come first;
    /// collective where there are any.
    void divide_level(Balance& result, MPI_Comm comm) {
        std::size_t num_lots = 0;
        for (Node& node : nodes_) {
            if (!is_divided(node)) continue;
            node.lot = num_lots++;
            children_[node.lot] = objects_.sum(
                objects_.listed(node.range, node.chosen->search.axis(), node.chosen->length));
        }
        lots_before(num_lots, comm);
        for (Node& node : nodes_) {
            Cut& cut = result.cuts.tree[node.at.node];
            cut.divides = is_divided(node) ? 1 : 0;
            if (!is_divided(node)) {
                node.middle = objects_.divide(node.range, cut);
                continue;
            }
            const LevelSearch& s = *node.chosen;
            node.middle = objects_.divide(node.range, cut,
                                          objects_.listed(node.range, s.search.axis(), s.length),
                                          s.search.before() + children_[node.lot], s.search.aim());
        }
    }

    /// Replaces the loads of lots by what lower ranks hold of them. Collective.
    void lots_before(std::size_t num_lots, MPI_Comm comm) {
        if (num_lots == 0) return;
        constexpr std::size_t entries = std::tuple_size_v<Load>;
        const int size = mpi::to_int(static_cast<std::int64_t>(num_lots * entries));
        mpi::check(MPI_Exscan(MPI_IN_PLACE, children_.data(), size, MPI_INT64_T, MPI_SUM, comm),
                   "MPI_Exscan");
        if (mpi::rank_of(comm) == 0)
            std::ranges::fill(std::span(children_).first(num_lots), Load{});
    }

    /// Goes on to the children of the nodes. Collective.
    void descend(Balance& result, MPI_Comm comm) {
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Node& node = nodes_[k];
            children_[2 * k] = objects_.sum({node.range.begin, node.middle});
            children_[2 * k + 1] = objects_.sum({node.middle, node.range.end});
        }
        LevelMessages::add_up(std::span(children_).first(2 * nodes_.size()), comm);
        next_.clear();
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Node& node = nodes_[k];
            go_to({node.at.lower(),
                   node.depth + 1,
                   {node.range.begin, node.middle},
                   children_[2 * k]},
                  result);
            go_to({node.at.upper(),
                   node.depth + 1,
                   {node.middle, node.range.end},
                   children_[2 * k + 1]},
                  result);
        }
        std::swap(nodes_, next_);
    }

    void go_to(const Node& child, Balance& result) {
        if (!child.at.is_part()) {
            next_.push_back(child);
        } else {
            finish_part(child, result);
        }
    }

    void finish_part(const Node& node, Balance& result) {
        objects_.assign(node.range, node.at.first_part, result.parts);
        part_loads_[static_cast<std::size_t>(node.at.first_part)] = node.all;
    }

    /// Measures the imbalance, which is that of the worst weight.
    void measure(const Load& all, Report& report) const {
        report.measured_imbalance = 1;
        report.least_imbalance = 1;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const bool is_count = k == most_weights;
            if (all[k] == 0 || is_count != report.all_weights_zero) continue;
            const std::vector<double>& sizes = sizes_[is_count ? 0 : k];
            const double mean =
                static_cast<double>(all[k]) / std::accumulate(sizes.begin(), sizes.end(), 0.0);
            for (std::size_t p = 0; p < part_loads_.size(); ++p) {
                if (part_loads_[p][k] == 0) continue;
                report.measured_imbalance =
                    std::max(report.measured_imbalance,
                             static_cast<double>(part_loads_[p][k]) / mean / sizes[p]);
            }
            report.least_imbalance = std::max(report.least_imbalance,
                                              units_.heaviest[k] / mean / std::ranges::max(sizes));
        }
        report.within_tolerance = report.measured_imbalance <= options_.imbalance_tolerance;
        report.part_weights.clear();
    }

    const Points& points_;
    const Criteria& criteria_;
    Options options_;
    std::array<std::vector<double>, most_weights> sizes_;  ///< of the parts, of each weight
    std::vector<Load> loads_;
    NormObjects objects_;
    LevelMessages messages_;
    AxisChoice axis_of_;
    std::vector<Load> part_loads_;
    std::vector<Load> children_;  ///< of all nodes, and before that the lots to divide
    std::vector<Node> nodes_, next_;
    std::vector<LevelSearch> searches_;
    Units units_;
    Factors values_{};  ///< of a unit of each weight
};

}  // namespace

void balance_norm(const Points& points, const Criteria& criteria, const Options& options,
                  Balance& result, Participant& self) {
    const Units units = choose_units(criteria, result.report.num_points, self.comm);
    const Box box = box_of_all(points, self.comm);
    std::optional<NormBisection> bisection;
    self.attempt([&] { bisection.emplace(points, criteria, options, units, box); });
    agree(self);
    bisection->run(result, self.comm);
}

}  // namespace rrcb::zoltan
