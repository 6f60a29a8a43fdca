// Memory of repeated calls: allocations and page faults are counted, not timed.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/held_memory.hpp"
#include "../support/memory_layer.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <sys/resource.h>

namespace rrcb {
namespace {

constexpr std::size_t many = 120000;

// Messages of other ranks touch pages as well, and so does the allocator of the sanitizer.
#ifdef __SANITIZE_ADDRESS__
constexpr bool counts_faults = false;
#else
constexpr bool counts_faults = true;
#endif

/// What a call costs that is repeated.
struct Cost {
    long bytes = 0;   ///< allocated at most at a time, beyond those before the call
    long faults = 0;  ///< pages that the system had to give
};

Cost cost_of(const std::function<void()>& call) {
    rusage before{};
    rusage after{};
    memory_layer::restart_peak();
    getrusage(RUSAGE_THREAD, &before);
    call();
    getrusage(RUSAGE_THREAD, &after);
    return {memory_layer::peak_bytes(), after.ru_minflt - before.ru_minflt};
}

struct Cloud {
    explicit Cloud(std::size_t count, int dimension = 2, bool weighted = false)
        : coordinates(test::uniform_cloud(count, dimension, 7 + static_cast<unsigned>(rank()))) {
        if (weighted) weights.assign(count, 1.5);
        points = Points(coordinates, dimension, weights);
    }

    std::vector<double> coordinates;
    std::vector<double> weights;
    Points points;
};

Options options_of(Refine refine, double tolerance = 1.01) {
    Options options{.num_parts = 2 * num_ranks(),
                    .imbalance_tolerance = tolerance,
                    .refine = refine,
                    .expert = {.cells_per_axis = 4}};
    return options;
}

void expect_same(const Balance& a, const Balance& b) {
    EXPECT_EQ(a.parts, b.parts);
    EXPECT_EQ(a.report.part_weights, b.report.part_weights);
}

/// Calls ten times; from the second call on there is little memory for each point: messages, cells
/// and lists of the points near cuts.
void expect_no_memory(const Cloud& cloud, const Options& options, bool reuses,
                      long most_bytes_a_point = 3) {
    Balance result = balance(cloud.points, MPI_COMM_WORLD, options);
    Balance first;
    for (int k = 0; k < 10; ++k) {
        const Cost cost = cost_of([&] {
            if (reuses)
                balance_into(result, cloud.points, MPI_COMM_WORLD, options, result.cuts);
            else
                balance_into(result, cloud.points, MPI_COMM_WORLD, options);
        });
        if (k == 0) {
            first = result;
            continue;
        }
        EXPECT_LT(cost.bytes, most_bytes_a_point * static_cast<long>(many)) << k;
        if (counts_faults && num_ranks() == 1) {
            EXPECT_LE(cost.faults, 16) << k;
        }
        expect_same(result, first);
    }
}

TEST(Buffers, serve_all_calls_but_the_first) {
    for (const int dimension : {1, 2, 3}) {
        for (const bool weighted : {false, true}) {
            const Cloud cloud(many, dimension, weighted);
            for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
                SCOPED_TRACE(testing::Message()
                             << dimension << "-D " << weighted << " " << static_cast<int>(refine));
                expect_no_memory(cloud, options_of(refine), false);
                expect_no_memory(cloud, options_of(refine), true);
            }
        }
    }
}

TEST(Buffers, serve_second_searches) {
    const Cloud cloud(many);
    expect_no_memory(cloud, options_of(Refine::tolerance, 1.0001), false);
    Options options = options_of(Refine::tolerance);
    options.expert.axes.min_width = {0.01, 0.01};
    expect_no_memory(cloud, options, false);
}

TEST(Buffers, serve_cuts_that_many_ranks_make) {
    if (num_ranks() < 3) GTEST_SKIP() << "needs three ranks";
    const Cloud cloud(many);
    Options options = options_of(Refine::tolerance);
    options.expert.max_root_parts = 2;
    // Lists of all points.
    expect_no_memory(cloud, options, false, 20);
}

TEST(Buffers, need_little_for_many_parts) {
    const Cloud cloud(10000, 3);
    constexpr long most_bytes_a_part = 650;
    Options options = options_of(Refine::tolerance);
    options.num_parts = 10000 * num_ranks();
    const Cost cost = cost_of([&] { balance(cloud.points, MPI_COMM_WORLD, options); });
    EXPECT_LE(cost.bytes, most_bytes_a_part * options.num_parts);
    RecordProperty("bytes_a_part", static_cast<int>(cost.bytes / options.num_parts));
}

TEST(Buffers, follow_the_number_of_points) {
    Balance result;
    for (const std::size_t count : {many, std::size_t{0}, std::size_t{100}, 2 * many, many / 2}) {
        const Cloud cloud(count);
        for (const Refine refine : {Refine::tolerance, Refine::exact}) {
            MPI_Comm fresh = MPI_COMM_NULL;
            MPI_Comm_dup(MPI_COMM_WORLD, &fresh);
            balance_into(result, cloud.points, MPI_COMM_WORLD, options_of(refine));
            expect_same(result, balance(cloud.points, fresh, options_of(refine)));
            MPI_Comm_free(&fresh);
        }
    }
}

TEST(Buffers, belong_to_a_communicator) {
    const Cloud large(many);
    const Cloud small(many / 8);
    const Options options = options_of(Refine::exact);
    const Balance of_large = balance(large.points, MPI_COMM_WORLD, options);
    const Balance of_small = balance(small.points, MPI_COMM_WORLD, options);
    const test::HeldMemory before;
    MPI_Comm other = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &other);
    for (int k = 0; k < 3; ++k) {
        expect_same(balance(large.points, MPI_COMM_WORLD, options), of_large);
        expect_same(balance(small.points, other, options), of_small);
    }
    MPI_Comm_free(&other);
    test::expect_no_growth(before, 6);
}

TEST(Buffers, survive_a_call_that_fails) {
    const Cloud cloud(many);
    const Options options = options_of(Refine::exact);
    Balance result = balance(cloud.points, MPI_COMM_WORLD, options);
    const Balance first = result;
    Cloud unusable(many);
    if (rank() == num_ranks() - 1)
        unusable.coordinates[5] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(balance_into(result, unusable.points, MPI_COMM_WORLD, options), Error);
    EXPECT_TRUE(result.parts.empty());
    expect_no_memory(cloud, options, false);
    balance_into(result, cloud.points, MPI_COMM_WORLD, options);
    expect_same(result, first);
}

TEST(Buffers, are_freed_when_asked) {
    const Cloud cloud(many);
    const Options options = options_of(Refine::exact);
    const Balance first = balance(cloud.points, MPI_COMM_WORLD, options);
    const long before = memory_layer::live_bytes();
    release_buffers(MPI_COMM_WORLD);
    release_buffers(MPI_COMM_WORLD);
    EXPECT_LT(memory_layer::live_bytes(), before);
    EXPECT_GE(memory_layer::live_bytes(), before - 40L * static_cast<long>(2 * many));
    expect_same(balance(cloud.points, MPI_COMM_WORLD, options), first);
    release_buffers(MPI_COMM_SELF);
    EXPECT_THROW(release_buffers(MPI_COMM_NULL), Error);
}

}  // namespace
}  // namespace rrcb
