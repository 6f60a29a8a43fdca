#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace rrcb::zoltan_test {
namespace {

/// How the weights of an object hang together, and where they lie.
enum class Kind { correlated, opposed, in_corners, heavy_tailed };
constexpr std::array kinds = {Kind::correlated, Kind::opposed, Kind::in_corners,
                              Kind::heavy_tailed};

/// Objects in a box with up to four weights each.
struct Weighted : Program {
    Weighted(Kind kind, int dimension_, int num_weights, unsigned seed, int count)
        : Program(dimension_) {
        std::mt19937 random(seed + 1000 * static_cast<unsigned>(rank));
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int i = 0; i < count; ++i) {
            std::vector<double> at;
            for (int a = 0; a < dimension; ++a) at.push_back(uniform(random) * (1 + (a == 0)));
            std::array<float, 4> mine{};
            const double common = uniform(random);
            for (int k = 0; k < 4; ++k) {
                const double x = at[std::size_t(k / 2 % dimension)];
                double weight = 1;
                if (kind == Kind::correlated) weight = 0.5 + common + 0.2 * uniform(random);
                if (kind == Kind::opposed) weight = k % 2 == 0 ? x : (k / 2 == 0 ? 2 : 1) - x;
                if (kind == Kind::in_corners) {
                    double far = 0;
                    for (int a = 0; a < dimension; ++a) {
                        const double corner = (k >> (a % 2)) % 2;
                        far += std::pow(at[std::size_t(a)] / (1 + (a == 0)) - corner, 2);
                    }
                    weight = std::exp(-8 * far);
                }
                if (kind == Kind::heavy_tailed)
                    weight = std::pow(uniform(random) + 1e-3, -0.7);
                mine[std::size_t(k)] = static_cast<float>(weight);
            }
            add(at, mine[0]);
            further.push_back(mine);
        }
        further_weight = [this](int object, int k) {
            return further[std::size_t(object)][std::size_t(k)];
        };
        set("OBJ_WEIGHT_DIM", std::to_string(num_weights));
        set("RETURN_LISTS", "PARTS");
        set("REMAP", "0");
    }

    std::vector<std::array<float, 4>> further;
};

/// Heaviest part over mean part, of the weight that is worst.
double worst_imbalance(const Weighted& program, const Outcome& outcome, int num_weights,
                       int num_parts) {
    std::vector<double> sums(std::size_t(num_weights * num_parts));
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (int k = 0; k < num_weights; ++k)
            sums[std::size_t(k * num_parts + parts[i])] +=
                static_cast<double>(program.further_weight(int(i), k));
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), int(sums.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    double worst = 0;
    for (int k = 0; k < num_weights; ++k) {
        const auto first = sums.begin() + k * num_parts;
        double total = 0;
        for (int p = 0; p < num_parts; ++p) total += first[p];
        worst = std::max(worst, *std::max_element(first, first + num_parts) * num_parts / total);
    }
    return worst;
}

TEST(Norms, balance_no_worse_than_rcb) {
    for (int norm = 1; norm <= 3; ++norm) {
        double mean_rcb = 0, mean_ours = 0, worst_ratio = 0;
        int n = 0, worse = 0;
        for (const Kind kind : kinds) {
            double kr = 0, ko = 0; int kn = 0;
            for (int weights = 2; weights <= 4; ++weights)
                for (const int parts : {2, 3, 4, 6, 8, 16}) {
                    std::array<double, 2> worst{};
                    for (const bool ours : {false, true}) {
                        Weighted program(kind, 2 + parts % 2, weights, unsigned(7 * parts + weights),
                                         2000 / 1);
                        program.set("LB_METHOD", ours ? "RRCB" : "RCB");
                        program.set("RCB_MULTICRITERIA_NORM", std::to_string(norm));
                        program.set("NUM_GLOBAL_PARTS", std::to_string(parts));
                        const Outcome outcome = program.partition();
                        EXPECT_EQ(outcome.code, ZOLTAN_OK);
                        worst[ours] = worst_imbalance(program, outcome, weights, parts);
                    }
                    kr += worst[0]; ko += worst[1]; ++kn;
                    worst_ratio = std::max(worst_ratio, worst[1] / worst[0]);
                    worse += worst[1] > 1.001 * worst[0];
                }
            mean_rcb += kr; mean_ours += ko; n += kn;
            std::printf("norm %d kind %d RCB %.4f ours %.4f\n", norm, int(kind), kr / kn, ko / kn);
        }
        std::printf("norm %d RCB %.4f ours %.4f worst ratio %.3f worse in %d of %d\n", norm, mean_rcb / n, mean_ours / n, worst_ratio, worse, n);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
