// What holds for every call of rrcb::balance, whatever the points and the options.
#include "../support/ranks.hpp"
#include "check_mpi.hpp"
#include "expectations.hpp"
#include "list_entries_mpi.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <bit>

namespace rrcb::test {
namespace {

constexpr int num_cases = 100;
constexpr int many_cases = 1000;  // some faults show in one case of a hundred

/// A case, this rank's points of it, and the answer.
struct Answer {
    explicit Answer(const Case& input) : Answer(input, input.options()) {}

    Answer(const Case& input, const Options& asked)
        : Answer(input, asked,
                 [&](const Points& points) { return balance(points, MPI_COMM_WORLD, asked); }) {}

    /// By a method of the paper.
    Answer(const Case& input, const PaperOptions& asked)
        : Answer(input, input.options(), [&](const Points& points) {
              return balance_as_in_paper(points, MPI_COMM_WORLD, asked);
          }) {}

    template <class Divide>
    Answer(const Case& input, const Options& asked, Divide&& divide)
        : cloud(cloud_of(input, num_ranks())),
          mine(cloud.of_rank(rank())),
          options(asked),
          result(divide(mine.points())) {
        parts = gathered(result.parts);
    }

    /// Parts of all points of the cloud from those of each rank's. Collective.
    std::vector<Part> gathered(const std::vector<Part>& my_parts) const {
        std::vector<Part> all(cloud.size(), 0);
        const std::vector<LocalIndex> held = cloud.held_by(rank());
        if (my_parts.size() != held.size()) throw std::runtime_error("not one part per point");
        for (LocalIndex k = 0; k < held.size(); ++k) all[held[k]] = my_parts[k];
        MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_INT, MPI_SUM,
                      MPI_COMM_WORLD);
        return all;
    }

    Cloud cloud;
    Cloud mine;
    Options options;
    Balance result;
    std::vector<Part> parts;
};

std::string first_of(std::initializer_list<std::string> faults) {
    for (const std::string& fault : faults)
        if (!fault.empty()) return fault;
    return {};
}

std::string fault_of_report(const Answer& answer) {
    const Report& report = answer.result.report;
    const std::vector<double> weights = part_weights(answer.mine.points(), answer.result.parts,
                                                     answer.options.num_parts, MPI_COMM_WORLD);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (report.details.num_points != static_cast<GlobalCount>(answer.cloud.size()))
        return "wrong count";
    if (!(std::abs(report.details.total_weight - total) <= 1e-12 * total))
        return "wrong total weight";
    const std::vector<double>& all = answer.cloud.weights;
    if (report.details.all_weights_zero != (!all.empty() && std::ranges::max(all) == 0))
        return "wrong about weights";
    if (std::isnan(report.imbalance) || report.details.all_weights_zero) return {};
    const double measured = imbalance(weights, answer.options.part_sizes);
    if (measured == report.imbalance) return {};
    if (std::abs(measured - report.imbalance) <= 1e-9 * measured) return {};
    return "imbalance " + std::to_string(measured) + ", reported as " +
           std::to_string(report.imbalance);
}

TEST(Balance, gives_every_point_one_part_that_look_ups_find) {
    expect_for_all_cases(
        [](const Case& input) {
            const Answer answer(input);
            return first_of({fault_of_range(answer.parts, answer.options.num_parts),
                             fault_of_look_ups(answer.cloud, answer.parts, answer.result.cuts),
                             fault_of_report(answer)});
        },
        many_cases);
}

TEST(Balance, is_within_the_tolerance_or_one_object) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const Answer answer(input);
            if (is_exact(answer.options))
                return fault_of_exact_cuts(answer.cloud, answer.parts, answer.options);
            if (!is_to_tolerance(answer.options)) return {};
            return fault_of_heaviest_part(answer.cloud, answer.parts, answer.options,
                                          answer.options.imbalance_tolerance);
        },
        num_cases);
}

/// What each part may miss of its share: half of the heaviest point at each cut above it, and more
/// if a point weighs less on the other side, of another size.
std::string fault_of_shares(const Answer& answer) {
    const Options& options = answer.options;
    const auto num_parts = static_cast<std::size_t>(options.num_parts);
    const std::vector<double>& weights = answer.result.report.part_weights;
    std::vector<double> sizes = options.part_sizes;
    if (sizes.empty()) sizes.assign(num_parts, 1);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double size = std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const bool by_count =
        answer.result.report.details.all_weights_zero || answer.cloud.weights.empty();
    const double heaviest = by_count ? 1 : std::ranges::max(answer.cloud.weights);
    const double at_cut = options.part_sizes.empty() ? heaviest / 2 : heaviest;
    const int levels = static_cast<int>(std::bit_width(num_parts - 1));
    for (std::size_t p = 0; p < num_parts; ++p)
        if (std::abs(weights[p] - total * (sizes[p] / size)) > levels * at_cut + 1e-9 * total)
            return "part " + std::to_string(p) + " has " + std::to_string(weights[p]) + " of " +
                   std::to_string(total);
    return {};
}

TEST(Balance, divides_points_in_one_place_where_that_is_asked_for) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Options options = input.options();
            options.refine = Refine::exact;
            options.expert.axes.plain = false;
            options.expert.coincident = Coincident::divide;
            const Answer answer(input, options);
            if (answer.cloud.size() == 0) return {};
            return first_of({fault_of_range(answer.parts, options.num_parts),
                             fault_of_report(answer), fault_of_shares(answer)});
        },
        num_cases);
}

bool same_bits(const Cuts& a, const Cuts& b) {
    if (a.tree.size() != b.tree.size()) return false;
    for (std::size_t k = 0; k < a.tree.size(); ++k)
        if (a.tree[k].axis != b.tree[k].axis ||
            std::memcmp(&a.tree[k].at, &b.tree[k].at, sizeof(Vector)) != 0)
            return false;
    return true;
}

TEST(Balance, gives_the_same_bits_twice_and_on_all_ranks) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const Answer first(input);
            const Answer second(input);
            Cuts at_root = first.result.cuts;
            MPI_Bcast(at_root.tree.data(), static_cast<int>(at_root.tree.size() * sizeof(Cut)),
                      MPI_BYTE, 0, MPI_COMM_WORLD);
            if (!same_bits(first.result.cuts, at_root)) return "other cuts than at the root";
            if (!same_bits(first.result.cuts, second.result.cuts)) return "other cuts";
            return first.parts == second.parts ? "" : "other parts";
        },
        num_cases);
}

TEST(BalanceAsInPaper, gives_every_point_one_part_that_look_ups_find_and_the_same_twice) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const PaperOptions options = input.paper_options();
            const Answer answer(input, options);
            if (!same_bits(answer.result.cuts, Answer(input, options).result.cuts))
                return "other cuts";
            const bool is_rcb = options.domain == PaperDomain::points &&
                                options.cut_rule == CutRule::weighted_fraction;
            return first_of(
                {fault_of_range(answer.parts, options.num_parts),
                 fault_of_look_ups(answer.cloud, answer.parts, answer.result.cuts),
                 fault_of_report(answer),
                 is_rcb ? fault_of_exact_cuts(answer.cloud, answer.parts, answer.options) : ""});
        },
        num_cases);
}

std::vector<Transfer> exports_of(const Plan& plan) {
    std::vector<Transfer> transfers;
    for (std::size_t k = 0; k < plan.export_indices.size(); ++k)
        transfers.push_back({rank(), static_cast<int>(plan.export_indices[k]),
                             plan.export_ranks.at(k), plan.export_parts.at(k)});
    return gathered(transfers);
}

std::vector<Transfer> imports_of(const Plan& plan) {
    std::vector<Transfer> transfers;
    for (std::size_t k = 0; k < plan.import_indices.size(); ++k)
        transfers.push_back({plan.import_ranks.at(k), static_cast<int>(plan.import_indices[k]),
                             rank(), plan.import_parts.at(k)});
    return gathered(transfers);
}

/// Every point whose part is not on its rank leaves it once, for a rank of that part.
std::string fault_of_exports(const Answer& answer, const std::vector<Transfer>& exports) {
    auto next = exports.begin();
    for (int from = 0; from < num_ranks(); ++from) {
        const std::vector<LocalIndex> held = answer.cloud.held_by(from);
        for (int index = 0; index < static_cast<int>(held.size()); ++index) {
            const Part part = answer.parts[held[static_cast<std::size_t>(index)]];
            const RankRange home = ranks_of_part(part, answer.options.num_parts, num_ranks());
            if (from >= home.first_rank && from < home.first_rank + home.count) continue;
            const std::string who =
                "point " + std::to_string(index) + " of rank " + std::to_string(from);
            if (next == exports.end() || (*next)[0] != from || (*next)[1] != index)
                return who + " does not leave";
            if ((*next)[2] < home.first_rank || (*next)[2] >= home.first_rank + home.count)
                return who + " leaves for the wrong rank";
            if ((*next++)[3] != part) return who + " leaves for the wrong part";
        }
    }
    return next == exports.end() ? "" : "more points leave than have to";
}

TEST(Plan, moves_every_point_that_has_to_move_once) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const Answer answer(input);
            const Plan lists = plan(answer.result.parts, answer.options.num_parts, MPI_COMM_WORLD);
            const std::vector<Transfer> exports = exports_of(lists);
            if (exports != imports_of(lists)) return "exports are not the imports";
            return fault_of_exports(answer, exports);
        },
        num_cases);
}

/// The points where their parts are.
Cloud migrated(const Answer& answer) {
    Cloud cloud = answer.cloud;
    for (LocalIndex i = 0; i < cloud.size(); ++i)
        cloud.owners[i] =
            ranks_of_part(answer.parts[i], answer.options.num_parts, num_ranks()).first_rank;
    return cloud;
}

/// True where a second call has nothing to mend, because the parts are within the tolerance. An
/// exact search may choose anew between cuts that are equally near.
bool is_settled(const Answer& answer) {
    if (is_exact(answer.options)) return false;
    std::vector<double> weights = part_weights(answer.mine.points(), answer.result.parts,
                                               answer.options.num_parts, MPI_COMM_WORLD);
    if (std::ranges::max(weights) == 0) weights = answer.result.report.part_weights;
    return !weights.empty() && imbalance(weights, answer.options.part_sizes) <=
                                   answer.options.imbalance_tolerance * (1 - 1e-12);
}

TEST(Balance, moves_nothing_when_called_again_with_its_own_cuts) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Answer answer(input);
            if (!is_settled(answer)) return {};
            answer.cloud = migrated(answer);
            const Cloud mine = answer.cloud.of_rank(rank());
            const Balance again =
                balance(mine.points(), MPI_COMM_WORLD, answer.options, answer.result.cuts);
            return answer.gathered(again.parts) == answer.parts ? "" : "points change their parts";
        },
        num_cases);
}

}  // namespace
}  // namespace rrcb::test
