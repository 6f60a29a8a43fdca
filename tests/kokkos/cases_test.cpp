// Random points in views: parts, totals and cuts, and the same bits in each call.
#include "ranks.hpp"
#include "views.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/experimental/kokkos.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace rrcb::test {
namespace {

/// A random case: the shape of the points is the same on all ranks, their number is not.
struct Case {
    Cloud cloud{};
    Options options{};
    bool is_float = false;
    bool is_strided = false;
    bool has_exact_totals = true;  ///< weights are multiples of 1/4
    std::string name{};

    explicit Case(unsigned seed) {
        std::mt19937_64 common(seed);
        const auto one_of = [&](unsigned number) { return static_cast<int>(common() % number); };
        cloud.dimension = 1 + one_of(3);
        const int shape = one_of(5);
        const bool is_weighted = one_of(2) == 0;
        is_float = one_of(2) == 0;
        is_strided = one_of(2) == 0;
        options.num_parts = 1 + one_of(one_of(4) == 0 ? 400 : 12);
        options.refine = one_of(3) == 0 ? Refine::exact : Refine::tolerance;
        options.expert.coincident = one_of(2) == 0 ? Coincident::together : Coincident::divide;
        const auto size = static_cast<std::size_t>(1) << one_of(15);
        if (one_of(4) == 0) options.expert.max_root_parts = 2;  // many ranks make more parts
        name = "seed " + std::to_string(seed) + " shape " + std::to_string(shape);
        std::mt19937_64 engine(1000 * seed + static_cast<unsigned>(rank()));
        add_points(shape, engine() % (2 * size), engine);
        if (!is_weighted) return;
        has_exact_totals = shape != 4;
        for (LocalIndex i = 0; i < cloud.count(); ++i)
            cloud.weights.push_back(shape == 4 ? std::exp(uniform(engine, -9, 9))
                                               : std::floor(uniform(engine, 0, 5)) / 4);
    }

  private:
    void add_points(int shape, std::size_t count, std::mt19937_64& engine) {
        for (std::size_t i = 0; i < count; ++i)
            for (int a = 0; a < cloud.dimension; ++a) {
                const double u = uniform(engine);
                double x = u;
                if (shape == 1) x = std::floor(32 * u);          // a lattice
                if (shape == 2) x = 0.5 + std::pow(u - 0.5, 5);  // a cluster
                if (shape == 3)
                    x = (static_cast<double>(i) + u) /  // sorted
                        static_cast<double>(count);
                if (shape == 4) x = std::ldexp(u - 0.5, static_cast<int>(engine() % 40) - 20);
                cloud.x.push_back(static_cast<float>(x));
            }
    }
};

/// Result of a call on the host.
struct Answer {
    Cuts cuts{};
    Report report{};
    std::vector<Part> parts{};

    /// Returns a hash of the bits of cuts, parts and weights of parts.
    std::uint64_t hash() const {
        std::uint64_t sum = 1469598103934665603u;
        const auto add = [&](const void* bytes, std::size_t size) {
            for (std::size_t k = 0; k < size; ++k)
                sum = (sum ^ static_cast<const unsigned char*>(bytes)[k]) * 1099511628211u;
        };
        for (const Cut& cut : cuts.tree) {
            add(&cut.axis, sizeof cut.axis);
            add(cut.at.data(), sizeof cut.at);
        }
        add(parts.data(), parts.size() * sizeof(Part));
        add(report.part_weights.data(), report.part_weights.size() * sizeof(double));
        return sum;
    }
};

template <class T, class Layout>
Answer answer(const Case& test, const Cuts& previous) {
    const auto found = experimental::balance(Device(), view_of<T, Layout>(test.cloud),
                                             on_device(test.cloud.weights), MPI_COMM_WORLD,
                                             test.options, previous);
    return {found.cuts, found.report, on_host(found.parts)};
}

Answer answer(const Case& test, const Cuts& previous, bool other_layout) {
    using Kokkos::LayoutLeft, Kokkos::LayoutRight, Kokkos::LayoutStride;
    if (test.is_strided)
        return other_layout ? answer<float, LayoutLeft>(test, previous)
                            : answer<double, LayoutStride>(test, previous);
    if (test.is_float && other_layout) return answer<double, LayoutRight>(test, previous);
    return test.is_float ? answer<float, LayoutRight>(test, previous)
                         : answer<double, LayoutLeft>(test, previous);
}

void expect_totals(const Case& test, const Answer& found) {
    std::vector<double> weights(static_cast<std::size_t>(test.options.num_parts));
    for (std::size_t i = 0; i < found.parts.size(); ++i)
        weights.at(static_cast<std::size_t>(found.parts[i])) += test.cloud.points().weight(i);
    MPI_Allreduce(MPI_IN_PLACE, weights.data(), test.options.num_parts, MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
    if (found.report.part_weights.empty()) return;  // not counted
    ASSERT_EQ(found.report.part_weights.size(), weights.size());
    double total = 0;
    for (const double weight : weights) total += weight;
    for (std::size_t p = 0; p < weights.size() && total > 0; ++p)
        EXPECT_NEAR(found.report.part_weights[p], weights[p], 1e-9 * total) << test.name;
}

void expect_parts_of_the_cuts(const Case& test, const Answer& found) {
    if (test.options.expert.coincident == Coincident::divide) return;
    std::vector<Part> parts(test.cloud.count());
    assign(found.cuts, test.cloud.points(), parts);
    EXPECT_EQ(found.parts, parts) << test.name;
}

/// Compares parts by exact cuts with those of the host whose cuts cross the same axes.
void expect_parts_of_the_host(const Case& test, const Answer& found) {
    if (test.options.refine != Refine::exact || !test.has_exact_totals) return;
    std::vector<int> axes;
    for (const Cut& cut : found.cuts.tree) axes.push_back(cut.axis);
    Options options = test.options;
    options.expert.axes.order = AxisOrder::given(axes);
    options.expert.tree = found.cuts.shape;
    const Balance host = balance(test.cloud.points(), MPI_COMM_WORLD, options);
    EXPECT_EQ(found.parts, host.parts) << test.name;
}

TEST(Cases, have_the_parts_of_their_cuts_and_repeat_their_bits) {
    const char* const wanted = std::getenv("RRCB_KOKKOS_CASES");
    const unsigned num_cases = wanted == nullptr ? 40 : static_cast<unsigned>(std::atoi(wanted));
    std::uint64_t all = 0;
    for (unsigned seed = 0; seed < num_cases; ++seed) {
        const Case test(seed);
        const Answer cold = answer(test, {}, false);
        const Answer next = answer(test, cold.cuts, false);
        for (const Answer* found : {&cold, &next}) {
            expect_totals(test, *found);
            expect_parts_of_the_cuts(test, *found);
        }
        expect_parts_of_the_host(test, cold);
        EXPECT_EQ(answer(test, {}, true).hash(), cold.hash()) << test.name;
        EXPECT_EQ(answer(test, cold.cuts, true).hash(), next.hash()) << test.name;
        all = all * 31 + cold.hash() + 7 * next.hash();
    }
    RecordProperty("bits", std::to_string(all));
    if (wanted != nullptr && rank() == 0)
        std::printf("%u cases, bits %016llx\n", num_cases, static_cast<unsigned long long>(all));
}

}  // namespace
}  // namespace rrcb::test
