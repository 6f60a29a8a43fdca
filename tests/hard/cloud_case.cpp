// cloud_case --list
// cloud_case METHOD CLOUD...
//
// A Zoltan program that divides clouds by RCB, RRCB or RRCB_EXACT, one part per rank, and divides
// them again once every object is where its part is. Rank 0 prints a line per cloud.
#include "callbacks_mpi.hpp"
#include "checks_mpi.hpp"
#include "methods.hpp"

#include <cstdio>

namespace {

using rrcb::hard_test::Cloud;
using rrcb::hard_test::parts_of;
using rrcb::hard_test::Share;
using rrcb::zoltan_test::Outcome;
using rrcb::zoltan_test::Program;

void set_parameters(Program& program, const Cloud& cloud, const std::string& method) {
    program.set("LB_METHOD", method == "RCB" ? "RCB" : "RRCB");
    if (method != "RCB") program.set("RRCB_REFINE", method == "RRCB" ? "TOLERANCE" : "EXACT");
    program.set({{"OBJ_WEIGHT_DIM", cloud.weight == nullptr ? "0" : "1"}, {"KEEP_CUTS", "1"}});
    program.set("RETURN_LISTS", "PARTS");
}

int sum_over_ranks(int value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

/// The parts of the objects in each place: several where the balance needs them divided.
std::map<rrcb::Vector, std::set<int>> parts_of_places(const Cloud& cloud,
                                                      std::span<const rrcb::Part> all) {
    std::map<rrcb::Vector, std::set<int>> parts;
    for (std::size_t i = 0; i < all.size(); ++i) {
        rrcb::Vector x = cloud.position(static_cast<int>(i));
        std::fill(x.begin() + cloud.dimension, x.end(), 0.0);
        parts[x].insert(all[i]);
    }
    return parts;
}

/// How many objects are looked up in a part that has no object in their place.
int wrong_look_ups(const Program& program, const Cloud& cloud, std::span<const rrcb::Part> all) {
    int wrong = 0;
    const auto places = parts_of_places(cloud, all);
    const auto stride = static_cast<std::size_t>(program.dimension);
    for (int i = 0; i < program.size(); ++i) {
        rrcb::Vector x{};
        std::copy_n(&program.coordinates[static_cast<std::size_t>(i) * stride], stride, x.begin());
        int rank = -1, part = -1;
        Zoltan_LB_Point_PP_Assign(program.zz, x.data(), &rank, &part);
        wrong += places.at(x).contains(part) ? 0 : 1;
    }
    return sum_over_ranks(wrong);
}

/// How many objects change rank when all are where their parts are.
int moved_again(Program& program, const Cloud& cloud, std::span<const rrcb::Part> all) {
    fill(program, share_of(cloud, all, program.rank));
    const std::vector<int> parts = parts_of(program, program.partition());
    const auto stays = std::ranges::count(parts, program.rank);
    return sum_over_ranks(static_cast<int>(parts.size()) - static_cast<int>(stays));
}

const char* name_of(int code) {
    if (code == ZOLTAN_OK) return "";
    if (code == ZOLTAN_MEMERR) return "MEMERR, ";
    return code == ZOLTAN_WARN ? "WARN, " : "FATAL, ";
}

double least_imbalance(const Cloud& cloud, int count, int num_parts) {
    double heaviest = 0;
    double total = 0;
    for (int i = 0; i < count; ++i) {
        heaviest = std::max(heaviest, weight_of(cloud, i));
        total += weight_of(cloud, i);
    }
    return total > 0 ? std::max(1.0, heaviest * num_parts / total) : 1;
}

void run(const std::string& method, const Cloud& cloud) {
    Program program(cloud.dimension);
    const int num_parts = program.num_ranks;
    const int count = cloud.count(num_parts);
    const auto owners =
        owners_of(cloud, count, rrcb::hard_test::Layout::scattered, program.num_ranks);
    const Share share = share_of(cloud, owners, program.rank);
    set_parameters(program, cloud, method);
    fill(program, share);
    const Outcome outcome = program.partition();
    const std::vector<int> parts = parts_of(program, outcome);
    const auto all = join_parts(share, parts, count, num_parts);
    const int wrong = count == 0 ? 0 : wrong_look_ups(program, cloud, all);
    const int moved = moved_again(program, cloud, all);
    if (program.rank != 0) return;
    std::printf("%s;%s;%.4f;%s%.4f, %d, %d\n", method.c_str(), cloud.name,
                least_imbalance(cloud, count, num_parts), name_of(outcome.code),
                imbalance_of(cloud, all, num_parts), wrong, moved);
    std::fflush(stdout);
}

void list_clouds() {
    using namespace rrcb::hard_test;
    for (const auto list :
         {clouds_hard_by_position(), clouds_hard_by_weight(), clouds_hard_by_distribution()})
        for (const std::string& name : names_of(list)) std::printf("%s\n", name.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "--list") {
        list_clouds();
        return 0;
    }
    MPI_Init(&argc, &argv);
    for (int k = 2; k < argc; ++k) run(argv[1], rrcb::hard_test::find_cloud(argv[k]));
    MPI_Finalize();
    return 0;
}
