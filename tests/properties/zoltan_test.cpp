// What holds for every call through Zoltan's interface, whatever the objects and the parameters.
#include "../support/ranks.hpp"
#include "../zoltan/program.hpp"
#include "check_mpi.hpp"
#include "expectations.hpp"
#include "list_entries_mpi.hpp"

#include <rrcb/plan.hpp>

namespace rrcb::test {
namespace {

using zoltan_test::ListCopy;
using zoltan_test::Outcome;
using zoltan_test::Program;

constexpr int num_cases = 100;

/// Digit of a case's free number, 0 ... base - 1.
int digit(const Case& input, int place, int base) {
    return (input.shape.choice >> (3 * place)) % base;
}

const char* domain_of(const Case& input) {
    constexpr std::array domains = {"ANALYTIC", "ANALYTIC", "SAMPLED", "POINTS"};
    return domains[static_cast<std::size_t>(digit(input, 3, 4))];
}

/// Whether RRCB's own method divides the objects, not one of the paper's.
bool is_own_method(const Case& input) {
    return domain_of(input) == std::string_view("ANALYTIC");
}

/// The case with numbers that floats can hold.
Case told(Case input) {
    Case::Shape& shape = input.shape;
    shape.sizes = Sizes::few_values;
    if (shape.weights == Weights::many_decades || shape.weights == Weights::subnormal)
        shape.weights = Weights::decades;
    return input;
}

/// The points as the callbacks tell them: weights are floats.
Cloud told_cloud(const Case& input) {
    Cloud cloud = cloud_of(input, num_ranks());
    for (double& weight : cloud.weights) weight = static_cast<double>(static_cast<float>(weight));
    return cloud;
}

void set_part_sizes(Program& program, const std::vector<std::int32_t>& sizes) {
    std::vector<int> numbers(sizes.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<float> values(sizes.begin(), sizes.end());
    std::vector<int> first_weights(sizes.size(), 0);
    const int mine = rank() == 0 ? static_cast<int>(sizes.size()) : 0;
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, mine, numbers.data(), first_weights.data(),
                             values.data());
}

void set_parameters(Program& program, const Case& input) {
    constexpr std::array refinements = {"NONE", "TOLERANCE", "EXACT"};
    const Case::Shape& shape = input.shape;
    program.set({{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", std::to_string(shape.num_parts)}});
    program.set("OBJ_WEIGHT_DIM", shape.weights == Weights::none ? "0" : "1");
    program.set("RRCB_DOMAIN", domain_of(input));
    program.set("RRCB_REFINE", refinements[static_cast<std::size_t>(shape.refine)]);
    if (!is_own_method(input))
        program.set("RRCB_CUT_RULE", digit(input, 4, 4) == 0 ? "MIDPOINT" : "WEIGHTED");
    program.set("IMBALANCE_TOL", std::to_string(shape.tolerance));
    program.set({{"RCB_RECTILINEAR_BLOCKS", std::to_string(shape.plain_cuts)}, {"KEEP_CUTS", "1"}});
    program.set("REMAP", std::to_string(digit(input, 0, 2)));
    program.set("NUM_GID_ENTRIES", std::to_string(2 + digit(input, 1, 2)));
    program.set("NUM_LID_ENTRIES", std::to_string(digit(input, 2, 3)));
    if (!input.part_sizes.empty()) set_part_sizes(program, input.part_sizes);
}

/// A program with this rank's objects of a case.
struct Caller {
    explicit Caller(const Case& input)
        : cloud(told_cloud(told(input))), program(cloud.dimension), options(told(input).options()) {
        const Cloud mine = cloud.of_rank(rank());
        const Points points = mine.points();
        for (LocalIndex i = 0; i < mine.size(); ++i) {
            const Vector x = points.position(i);
            program.add({x.begin(), x.begin() + cloud.dimension},
                        static_cast<float>(points.weight(i)));
        }
        set_parameters(program, input);
    }

    Outcome call(const char* lists) {
        program.set("RETURN_LISTS", lists);
        const Outcome outcome = program.partition();
        if (outcome.code != ZOLTAN_OK && outcome.code != ZOLTAN_WARN)
            throw std::runtime_error("code " + std::to_string(outcome.code));
        return outcome;
    }

    Cloud cloud;
    Program program;
    Options options;
};

/// Parts of the local objects from a list that names all of them; none when it does not.
std::optional<std::vector<Part>> my_parts(const Program& program, const ListCopy& list) {
    if (list.count != program.size()) return {};
    std::vector<Part> parts(static_cast<std::size_t>(list.count), -1);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::size_t object = list.global_ids[k][0];
        if (object >= parts.size() || parts[object] != -1) return {};
        for (std::size_t w = 0; w < list.global_ids[k].size(); ++w)
            if (list.global_ids[k][w] != program.gid_word(static_cast<int>(object), int(w)))
                return {};
        for (std::size_t w = 0; list.has_local_ids && w < list.local_ids[k].size(); ++w)
            if (list.local_ids[k][w] != program.lid_word(static_cast<int>(object), int(w)))
                return {};
        parts[object] = list.parts[k];
    }
    return parts;
}

/// Parts of all objects of the cloud. Collective.
std::vector<Part> all_parts(const Cloud& cloud, const std::vector<Part>& mine) {
    std::vector<Part> all(cloud.size(), 0);
    const std::vector<LocalIndex> held = cloud.held_by(rank());
    for (LocalIndex k = 0; k < held.size(); ++k) all[held[k]] = mine[k];
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_INT, MPI_SUM,
                  MPI_COMM_WORLD);
    return all;
}

/// The parts of the objects in each place: several where the balance needs them divided.
std::map<Vector, std::set<Part>> parts_of_places(const Cloud& cloud,
                                                 const std::vector<Part>& parts) {
    std::map<Vector, std::set<Part>> places;
    const Points points = cloud.points();
    for (LocalIndex i = 0; i < points.count; ++i) places[points.position(i)].insert(parts[i]);
    return places;
}

std::string fault_of_look_ups(Program& program, const Cloud& cloud,
                              const std::vector<Part>& parts) {
    const auto places = parts_of_places(cloud, parts);
    for (int i = 0; i < program.size(); ++i) {
        Vector x{};
        std::copy_n(program.coordinates.begin() + i * program.dimension, program.dimension,
                    x.begin());
        const std::string who = "object " + std::to_string(i);
        int owner = -1;
        int part = -1;
        if (Zoltan_LB_Point_PP_Assign(program.zz, x.data(), &owner, &part) != ZOLTAN_OK ||
            !places.at(x).contains(part))
            return who + " is looked up in a part with none in its place";
        std::vector<int> owners(100);
        std::vector<int> touched(100);
        int num_owners = 0;
        int num_touched = 0;
        Zoltan_LB_Box_PP_Assign(program.zz, x[0], x[1], x[2], x[0], x[1], x[2], owners.data(),
                                &num_owners, touched.data(), &num_touched);
        const auto& here = places.at(x);
        touched.resize(static_cast<std::size_t>(num_touched));
        if (!std::ranges::includes(touched, here)) return who + "'s box misses a part";
        if (here.size() == 1 && num_touched != 1) return who + "'s box touches other parts";
        if (std::find(owners.begin(), owners.begin() + num_owners, owner) ==
            owners.begin() + num_owners)
            return who + "'s box touches other ranks";
    }
    return {};
}

TEST(ZoltanCall, gives_every_object_one_part_that_look_ups_find) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Caller caller(input);
            const Outcome outcome = caller.call("PARTS");
            const auto parts = my_parts(caller.program, outcome.exports);
            if (!parts) throw std::runtime_error("an object is missing, doubled or renamed");
            const std::vector<Part> all = all_parts(caller.cloud, *parts);
            const std::string fault = fault_of_range(*parts, caller.options.num_parts);
            return fault.empty() ? fault_of_look_ups(caller.program, caller.cloud, all) : fault;
        },
        num_cases);
}

TEST(ZoltanCall, is_within_the_tolerance_or_one_object) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Caller caller(input);
            const auto mine = my_parts(caller.program, caller.call("PARTS").exports);
            if (!mine) throw std::runtime_error("an object is missing, doubled or renamed");
            const std::vector<Part> parts = all_parts(caller.cloud, *mine);
            if (!is_own_method(input) || !is_to_tolerance(caller.options)) return {};
            const double tolerance =
                is_exact(caller.options) ? 1 : caller.options.imbalance_tolerance;
            return fault_of_heaviest_part(caller.cloud, parts, caller.options, tolerance);
        },
        num_cases);
}

TEST(ZoltanCall, answers_alike_twice) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Caller first(input);
            Caller second(input);
            const Outcome a = first.call("PARTS");
            const Outcome b = second.call("PARTS");
            return a.exports.parts == b.exports.parts && a.code == b.code ? "" : "other parts";
        },
        num_cases);
}

/// What the lists of all ranks say, ascending. Collective.
std::vector<Transfer> transfers_of(const ListCopy& list, bool is_export) {
    std::vector<Transfer> mine;
    for (std::size_t k = 0; k < list.ranks.size(); ++k) {
        const auto object = static_cast<int>(list.global_ids[k][0]);
        const auto home = static_cast<int>(list.global_ids[k][1]);
        mine.push_back({home, object, is_export ? list.ranks[k] : rank(), list.parts[k]});
    }
    return gathered(mine);
}

/// Every object whose part is on other ranks leaves for one of them, once.
std::string fault_of_exports(const Caller& caller, const std::vector<Part>& parts,
                             const std::vector<Transfer>& exports) {
    std::map<std::pair<int, int>, Transfer> by_object;
    for (const Transfer& transfer : exports)
        if (!by_object.insert({{transfer[0], transfer[1]}, transfer}).second)
            return "an object leaves twice";
    for (int home = 0; home < num_ranks(); ++home) {
        const std::vector<LocalIndex> held = caller.cloud.held_by(home);
        for (std::size_t k = 0; k < held.size(); ++k) {
            const Part part = parts[held[k]];
            const RankRange ranks = ranks_of_part(part, caller.options.num_parts, num_ranks());
            const auto is_home = [&](int rank) {
                return rank >= ranks.first_rank && rank < ranks.first_rank + ranks.count;
            };
            const auto found = by_object.find({home, static_cast<int>(k)});
            if (found == by_object.end() && !is_home(home)) return "an object does not leave";
            if (found == by_object.end()) continue;
            if (found->second[3] != part) return "an object leaves for another part";
            if (!is_home(found->second[2])) return "an object leaves for a wrong rank";
        }
    }
    return {};
}

TEST(ZoltanCall, exports_what_others_import) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            Caller caller(input);
            const auto mine = my_parts(caller.program, caller.call("PARTS").exports);
            if (!mine) throw std::runtime_error("an object is missing, doubled or renamed");
            const std::vector<Part> parts = all_parts(caller.cloud, *mine);
            const bool at_once = digit(input, 5, 2) == 0;
            const Outcome leaving = caller.call(at_once ? "ALL" : "EXPORT");
            const Outcome coming = at_once ? leaving : caller.call("IMPORT");
            const std::vector<Transfer> exports = transfers_of(leaving.exports, true);
            if (exports != transfers_of(coming.imports, false))
                return "exports are not the imports";
            return fault_of_exports(caller, parts, exports);
        },
        num_cases);
}

}  // namespace
}  // namespace rrcb::test
