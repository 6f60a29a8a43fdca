// Structs of programs that were compiled with fewer members than the library has, or with more: the
// page after each cannot be read or written.
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.h>

#include <sys/mman.h>
#include <unistd.h>

namespace rrcb {
namespace {

/// Memory for structs, which end where the accessible memory ends.
class Page {
  public:
    Page() : bytes_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
        memory_ = static_cast<char*>(
            mmap(nullptr, 2 * bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        EXPECT_EQ(mprotect(memory_ + bytes_, bytes_, PROT_NONE), 0);
    }
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;
    ~Page() { munmap(memory_, 2 * bytes_); }

    /// Returns a copy as a program with `size` bytes has it, at the end of the page.
    template <class Struct>
    Struct* copy(const Struct& from, std::size_t size, std::size_t end = 0) {
        char* place = memory_ + bytes_ - end - size;
        std::memset(place, 0, size);
        std::memcpy(place, &from, std::min(size, sizeof from));
        std::memcpy(place, &size, sizeof size);
        return reinterpret_cast<Struct*>(place);
    }

  private:
    std::size_t bytes_;
    char* memory_;
};

void expect_error(int code, const std::string& text) {
    EXPECT_EQ(code, RRCB_INVALID_ARGUMENT);
    EXPECT_NE(std::string(rrcb_last_error()).find(text), std::string::npos) << rrcb_last_error();
}

template <class Struct>
int differing_words(const Struct& a, const Struct& b, std::size_t size) {
    int differing = 0;
    for (std::size_t at = sizeof size; at < std::min(size, sizeof a); at += 4)
        differing += std::memcmp(reinterpret_cast<const char*>(&a) + at,
                                 reinterpret_cast<const char*>(&b) + at, 4) != 0;
    return differing;
}

/// Balanced points, with a plan, ghosts and neighbours.
class Sizes : public testing::Test {
  protected:
    void SetUp() override {
        for (int i = 0; i < 40; ++i)
            x_.insert(x_.end(), {0.025 * i + 0.001 * rank(), 0.3 + 0.01 * (i % 7)});
        parts_.resize(40);
        points_ = rrcb_interleaved_points(RRCB_DOUBLE, 2, 40, x_.data(), nullptr);
        ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer_), RRCB_OK);
        ASSERT_EQ(rrcb_balance(balancer_, &points_, parts_.data()), RRCB_OK) << rrcb_last_error();
        ASSERT_EQ(rrcb_plan(balancer_, 40, parts_.data()), RRCB_OK);
        ASSERT_EQ(rrcb_get_plan(balancer_, &plan_), RRCB_OK);
    }
    void TearDown() override { rrcb_balancer_destroy(&balancer_); }

    /// Refuses structs without a size, and with members that the library lacks.
    template <class Struct, class Call>
    void expect_checked(const Struct& initial, const Call& call, const std::string& macro) {
        for (const std::size_t none : {0, 7, 1 << 20}) {
            Struct* given = page_.copy(initial, sizeof initial);
            given->size = none;
            expect_error(call(given), "is not set; initialise it by " + macro);
        }
        Struct* later = page_.copy(initial, sizeof initial + 8);
        reinterpret_cast<char*>(later)[sizeof initial + 7] = 1;
        expect_error(call(later), macro + " of a later version, sets a member");
        EXPECT_EQ(call(page_.copy(initial, sizeof initial + 8)), RRCB_OK) << rrcb_last_error();
    }

    /// Fills structs of any size, of which `padding` words of 4 bytes are no members.
    template <class Struct, class Call>
    void expect_filled(const Struct& initial, const Call& call, const std::string& macro,
                       int padding = 0) {
        Struct all = initial;
        ASSERT_EQ(call(&all), RRCB_OK) << rrcb_last_error();
        for (std::size_t size = sizeof(std::size_t); size <= sizeof all + 16; size += 8) {
            Struct* given = page_.copy(initial, size);
            ASSERT_EQ(call(given), RRCB_OK) << rrcb_last_error();
            EXPECT_EQ(given->size, size);
            Struct filled = initial;
            std::memcpy(&filled, given, std::min(size, sizeof filled));
            EXPECT_LE(differing_words(all, filled, size), padding) << size;
            for (std::size_t at = sizeof all; at < size; ++at)
                EXPECT_EQ(reinterpret_cast<const char*>(given)[at], 0);
        }
        expect_checked(initial, call, macro);
    }

    Page page_;
    std::vector<double> x_;
    std::vector<std::int32_t> parts_;
    rrcb_points points_ = RRCB_POINTS_INIT;
    rrcb_plan_lists plan_ = RRCB_PLAN_LISTS_INIT;
    rrcb_balancer* balancer_ = nullptr;
};

TEST_F(Sizes, of_results_are_kept) {
    expect_filled(
        rrcb_report RRCB_REPORT_INIT, [&](auto* to) { return rrcb_get_report(balancer_, to); },
        "RRCB_REPORT_INIT");
    expect_filled(
        rrcb_cuts RRCB_CUTS_INIT, [&](auto* to) { return rrcb_get_cuts(balancer_, to); },
        "RRCB_CUTS_INIT", 1);
    expect_filled(
        rrcb_plan_lists RRCB_PLAN_LISTS_INIT,
        [&](auto* to) { return rrcb_get_plan(balancer_, to); }, "RRCB_PLAN_LISTS_INIT");
    std::vector<double> here(2 * plan_.num_points_after);
    const rrcb_column column = RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, x_.data(), here.data());
    expect_filled(
        rrcb_transfer_report RRCB_TRANSFER_REPORT_INIT,
        [&](auto* to) {
            rrcb_transfer_options options = RRCB_TRANSFER_OPTIONS_INIT;
            options.report = to;
            return rrcb_transfer(balancer_, 1, &column, &options);
        },
        "RRCB_TRANSFER_REPORT_INIT");
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(num_ranks()));
    expect_filled(
        rrcb_remap_report RRCB_REMAP_REPORT_INIT,
        [&](auto* to) {
            return rrcb_remap(balancer_, 40, parts_.data(), nullptr, nullptr, numbers.size(),
                              numbers.data(), to);
        },
        "RRCB_REMAP_REPORT_INIT", 1);
}

TEST_F(Sizes, of_lists_and_views_are_kept) {
    ASSERT_EQ(rrcb_transfer(balancer_, 0, nullptr, nullptr), RRCB_OK);
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    const rrcb_points none = rrcb_interleaved_points(RRCB_DOUBLE, 2, 0, nullptr, nullptr);
    rrcb_ghosts* ghosts = nullptr;
    ASSERT_EQ(rrcb_ghosts_create(balancer_, &none, &options, &ghosts), RRCB_OK);
    expect_filled(
        rrcb_ghost_plan RRCB_GHOST_PLAN_INIT,
        [&](auto* to) { return rrcb_ghosts_get_plan(ghosts, to); }, "RRCB_GHOST_PLAN_INIT");
    rrcb_ghosts_destroy(&ghosts);
    const std::vector<std::uint64_t> keys(40, RRCB_NO_GROUP);
    rrcb_groups* groups = nullptr;
    ASSERT_EQ(rrcb_groups_create(balancer_, &points_, keys.data(), RRCB_CENTRE, &groups), RRCB_OK);
    expect_filled(
        rrcb_points RRCB_POINTS_INIT, [&](auto* to) { return rrcb_groups_points(groups, to); },
        "RRCB_POINTS_INIT");
    rrcb_groups_destroy(&groups);
}

TEST_F(Sizes, of_arguments_leave_members_at_their_defaults) {
    const std::vector<double> weights(40, 1.0 + rank());
    rrcb_points weighed = points_;
    weighed.weights = weights.data();
    std::vector<std::int32_t> again(40);
    const auto balance = [&](const rrcb_points* points) {
        EXPECT_EQ(rrcb_set_cuts(balancer_, nullptr), RRCB_OK);
        return rrcb_balance(balancer_, points, again.data());
    };
    ASSERT_EQ(balance(page_.copy(weighed, sizeof weighed - 8)), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(again, parts_);
    expect_checked(weighed, balance, "RRCB_POINTS_INIT");

    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer_, &cuts), RRCB_OK);
    const rrcb_cut* tree = cuts.tree;
    const std::vector<rrcb_cut> copied(tree, tree + num_ranks() - 1);
    cuts.tree = copied.data();
    cuts.numbers = nullptr;
    cuts.debt = 0.5;
    const auto set_cuts = [&](const rrcb_cuts* given) { return rrcb_set_cuts(balancer_, given); };
    ASSERT_EQ(set_cuts(page_.copy(cuts, sizeof cuts - 8)), RRCB_OK) << rrcb_last_error();
    rrcb_cuts shown = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer_, &shown), RRCB_OK);
    EXPECT_EQ(shown.debt, 0);
    expect_checked(cuts, set_cuts, "RRCB_CUTS_INIT");

    rrcb_controller* controller = nullptr;
    ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controller), RRCB_OK);
    rrcb_report report = RRCB_REPORT_INIT;
    report.least_imbalance = 1;
    const auto rebalanced = [&](const rrcb_report* given) {
        return rrcb_controller_rebalanced(controller, given, 1);
    };
    EXPECT_EQ(rebalanced(page_.copy(report, sizeof report - 8)), RRCB_OK) << rrcb_last_error();
    expect_checked(report, rebalanced, "RRCB_REPORT_INIT");
    rrcb_controller_destroy(&controller);
}

TEST_F(Sizes, of_options_leave_members_at_their_defaults) {
    ASSERT_EQ(rrcb_transfer(balancer_, 0, nullptr, nullptr), RRCB_OK);
    const rrcb_points none = rrcb_interleaved_points(RRCB_DOUBLE, 2, 0, nullptr, nullptr);
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    const auto find = [&](const rrcb_ghost_options* given) {
        rrcb_ghosts* ghosts = nullptr;
        const int code = rrcb_ghosts_create(balancer_, &none, given, &ghosts);
        rrcb_ghosts_destroy(&ghosts);
        return code;
    };
    options.needs = 99;
    ASSERT_EQ(find(page_.copy(options, sizeof options - 8)), RRCB_OK) << rrcb_last_error();
    options.needs = RRCB_NEEDS_SCATTER;
    expect_checked(options, find, "RRCB_GHOST_OPTIONS_INIT");

    rrcb_neighbour_options distances = RRCB_NEIGHBOUR_OPTIONS_INIT;
    distances.cutoff = 0.1;
    const auto meet = [&](const rrcb_neighbour_options* given) {
        rrcb_neighbours* neighbours = nullptr;
        const int code = rrcb_neighbours_create(balancer_, given, &neighbours);
        rrcb_neighbours_destroy(&neighbours);
        return code;
    };
    distances.needs = 99;
    ASSERT_EQ(meet(page_.copy(distances, sizeof distances - 8)), RRCB_OK) << rrcb_last_error();
    distances.needs = RRCB_NEEDS_SCATTER;
    expect_checked(distances, meet, "RRCB_NEIGHBOUR_OPTIONS_INIT");
    const rrcb_transfer_options moving = RRCB_TRANSFER_OPTIONS_INIT;
    const auto transfer = [&](const rrcb_transfer_options* given) {
        return rrcb_transfer(balancer_, 0, nullptr, given);
    };
    expect_checked(moving, transfer, "RRCB_TRANSFER_OPTIONS_INIT");
}

/// Columns and arrays of programs with more members than the library: each is after the one before.
TEST_F(Sizes, of_elements_are_their_distances) {
    std::vector<double> here(2 * plan_.num_points_after);
    std::vector<std::int32_t> parts_here(plan_.num_points_after, -1);
    const rrcb_column x = RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, x_.data(), here.data());
    const rrcb_column parts = RRCB_COLUMN_INIT(RRCB_INT32, 1, parts_.data(), parts_here.data());
    const std::size_t size = sizeof x + 8;
    page_.copy(parts, size);
    const rrcb_column* columns = page_.copy(x, size, size);
    ASSERT_EQ(rrcb_transfer(balancer_, 2, columns, nullptr), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(parts_here, std::vector<std::int32_t>(parts_here.size(), rank()));
    page_.copy(parts, sizeof parts, 8);
    expect_error(rrcb_transfer(balancer_, 2, columns, nullptr), "their sizes differ");
    expect_checked(
        x, [&](auto* given) { return rrcb_transfer(balancer_, 1, given, nullptr); },
        "RRCB_COLUMN_INIT");

    rrcb_neighbour_options options = RRCB_NEIGHBOUR_OPTIONS_INIT;
    options.cutoff = options.travel = 0.1;
    rrcb_neighbours* neighbours = nullptr;
    ASSERT_EQ(rrcb_neighbours_create(balancer_, &options, &neighbours), RRCB_OK);
    const rrcb_points points =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, plan_.num_points_after, here.data(), nullptr);
    ASSERT_EQ(rrcb_neighbours_find_ghosts(neighbours, &points, nullptr), RRCB_OK);
    const void* const from[] = {here.data(), parts_here.data()};
    const rrcb_array doubles = RRCB_ARRAY_INIT(RRCB_DOUBLE, 2);
    const rrcb_array numbers = RRCB_ARRAY_INIT(RRCB_INT32, 1);
    const std::size_t wide = sizeof doubles + 8;
    const rrcb_array* second = page_.copy(numbers, wide);
    rrcb_array* arrays = page_.copy(doubles, wide, wide);
    ASSERT_EQ(rrcb_neighbours_fetch(neighbours, 2, from, arrays), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(arrays->size, wide);
    EXPECT_EQ(arrays->count, second->count);
    EXPECT_EQ(second->count > 0, num_ranks() > 1);
    std::free(arrays->values);
    std::free(second->values);
    rrcb_neighbours_destroy(&neighbours);
    const rrcb_shared_entries entries = RRCB_SHARED_ENTRIES_INIT;
    const auto sum = [&](const rrcb_shared_entries* given) {
        rrcb_neighbours* fresh = nullptr;  // Others could not be used after an error.
        EXPECT_EQ(rrcb_neighbours_create(balancer_, &options, &fresh), RRCB_OK);
        const int code = rrcb_neighbours_sum(fresh, given, 0, 0, nullptr);
        rrcb_neighbours_destroy(&fresh);
        return code;
    };
    expect_checked(entries, sum, "RRCB_SHARED_ENTRIES_INIT");
}

}  // namespace
}  // namespace rrcb
