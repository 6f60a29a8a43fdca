#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/paper.hpp>

#include <cfenv>

namespace rrcb {
namespace {

/// Writes "+moments -moments +gather ...".
struct Recorder : StageObserver {
    void begin(Stage stage) noexcept override { text += std::string(" +") + name_of(stage); }
    void end(Stage stage) noexcept override { text += std::string(" -") + name_of(stage); }
    std::string text;
};

/// The whole call up to the last stage; only the root bisects.
std::string start_of_call() {
    return std::string(" +moments -moments +gather -gather") +
           (rank() == 0 ? " +bisection -bisection" : "") + " +broadcast -broadcast";
}

std::string stages_seen(const Options& asked, const std::vector<double>& coordinates,
                        const Cuts* previous = nullptr) {
    Recorder recorder;
    Options options = asked;
    options.observer = &recorder;
    const Points points = interleaved_points(coordinates, 2);
    if (previous) balance(points, options, *previous, MPI_COMM_WORLD);
    if (!previous) balance(points, options, {}, MPI_COMM_WORLD);
    return recorder.text;
}

TEST(Stages, are_seen_in_their_order) {
    const auto cloud = test::uniform_cloud(500, 2, static_cast<unsigned>(rank()));
    Options options;
    EXPECT_EQ(stages_seen(options, cloud), start_of_call() + " +refinement -refinement");
    options.refine = Refine::none;
    EXPECT_EQ(stages_seen(options, cloud), start_of_call() + " +assignment -assignment");
}

TEST(Stages, of_methods_of_the_paper_are_seen_in_their_order) {
    const auto cloud = test::uniform_cloud(500, 2, static_cast<unsigned>(rank()));
    for (const PaperDomain domain : {PaperDomain::sampled, PaperDomain::points}) {
        Recorder recorder;
        const PaperOptions options{.domain = domain, .observer = &recorder};
        balance_as_in_paper(interleaved_points(cloud, 2), options, MPI_COMM_WORLD);
        EXPECT_EQ(recorder.text, start_of_call() + " +assignment -assignment");
    }
}

TEST(Stages, come_again_where_many_ranks_make_the_parts) {
    if (num_ranks() < 3) GTEST_SKIP() << "needs three ranks";
    auto cloud = test::uniform_cloud(500, 2, static_cast<unsigned>(rank()));
    Options options{.refine = Refine::exact, .tuning = {.central_parts = 2}};
    const std::string anew = start_of_call() + " +refinement -refinement +broadcast -broadcast";
    EXPECT_EQ(stages_seen(options, cloud), anew);
    options.refine = Refine::tolerance;
    EXPECT_EQ(stages_seen(options, cloud), anew);
    const Cuts cuts = balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD).cuts;
    const std::string moments = " +moments -moments";
    const std::string reuse = " +assignment -assignment" + start_of_call().substr(moments.size());
    EXPECT_EQ(stages_seen(options, cloud, &cuts), reuse);
    for (double& x : cloud) x *= x;
    EXPECT_EQ(stages_seen(options, cloud, &cuts), reuse + anew);
}

/// Notes whether it runs in the environment of the program, and leaves a flag behind.
struct EnvironmentRecorder : StageObserver {
    void begin(Stage) noexcept override { look(); }
    void end(Stage) noexcept override { look(); }
    void look() {
        is_of_program = is_of_program && std::fetestexcept(FE_ALL_EXCEPT) == flags &&
                        fegetexcept() == FE_DIVBYZERO;
        flags = FE_INEXACT | FE_UNDERFLOW;
        std::feraiseexcept(FE_UNDERFLOW);
    }
    bool is_of_program = true;
    int flags = FE_INEXACT;
};

TEST(Stages, are_observed_in_the_floating_point_environment_of_the_program) {
    EnvironmentRecorder recorder;
    Options options{.observer = &recorder};
    const auto cloud = test::uniform_cloud(500, 2, static_cast<unsigned>(rank()));
    std::fenv_t before;
    std::feholdexcept(&before);
    std::feraiseexcept(FE_INEXACT);
    feenableexcept(FE_DIVBYZERO);
    balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD);
    const int left = std::fetestexcept(FE_ALL_EXCEPT);
    std::fesetenv(&before);
    EXPECT_TRUE(recorder.is_of_program);
    EXPECT_EQ(left, FE_INEXACT | FE_UNDERFLOW);
}

TEST(Stages, end_when_a_call_fails) {
    auto cloud = test::uniform_cloud(500, 2, 1);
    if (is_last_rank()) cloud[7] = std::numeric_limits<double>::quiet_NaN();
    Recorder recorder;
    Options options{.observer = &recorder};
    EXPECT_THROW(balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD), Error);
    // The failure is broadcast where the cuts would be; there is nothing to bisect.
    EXPECT_EQ(recorder.text, " +moments -moments +gather -gather +broadcast -broadcast");
}

TEST(Stages, may_be_watched_on_one_rank_alone_and_change_nothing) {
    const auto cloud = test::uniform_cloud(500, 2, static_cast<unsigned>(rank()));
    const Points points = interleaved_points(cloud, 2);
    Recorder recorder;
    Options options;
    const Balance unwatched = balance(points, options, {}, MPI_COMM_WORLD);
    if (is_last_rank()) options.observer = &recorder;
    EXPECT_EQ(balance(points, options, {}, MPI_COMM_WORLD).parts, unwatched.parts);
    EXPECT_EQ(recorder.text.empty(), !is_last_rank());
}

}  // namespace
}  // namespace rrcb
