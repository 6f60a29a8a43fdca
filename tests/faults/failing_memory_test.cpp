#include "failing_memory.hpp"

#include "clouds.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

using test::FailingMemory;

constexpr int ok = -1;

/// Code of the Error that `step` throws, ok when it throws none.
template <class Step>
int code_of(Step&& step) {
    try {
        step();
        return ok;
    } catch (const Error& error) {
        return static_cast<int>(error.code());
    }
}

std::vector<double> cloud_here(int dimension) {
    return test::uniform_cloud(120, dimension, static_cast<unsigned>(test::rank() + 1));
}

/// Lets memory run short in the refinement alone.
class InRefinement : public StageObserver {
  public:
    void begin(Stage stage) noexcept override {
        memory_layer::count_allocations(stage == Stage::refinement);
    }
    void end(Stage) noexcept override { memory_layer::count_allocations(false); }
};

/// Balances again and again by `options`, from `previous` if given.
void fail_in_balance(Options options, const Cuts* previous = nullptr) {
    const std::vector<double> coordinates = cloud_here(2);
    const Points points = interleaved_points(coordinates, 2);
    InRefinement observer;
    options.observer = &observer;
    const auto call = [&] {
        return previous ? balance(points, options, MPI_COMM_WORLD, *previous)
                        : balance(points, options, MPI_COMM_WORLD);
    };
    const std::vector<Part> expected = call().parts;
    Balance result;
    FailingMemory(
        {ok, static_cast<int>(ErrorCode::out_of_memory)},
        [&] {
            result = {};
            return code_of([&] { result = call(); });
        },
        [&] { EXPECT_EQ(result.parts, expected); })
        .run();
}

Options refining(Refine refine) {
    Options options;
    options.num_parts = 6;
    options.refine = refine;
    options.imbalance_tolerance = 1.01;
    return options;
}

TEST(FailingMemory, in_cuts_refined_to_a_tolerance) {
    fail_in_balance(refining(Refine::tolerance));
}

TEST(FailingMemory, in_exact_cuts) {
    fail_in_balance(refining(Refine::exact));
}

TEST(FailingMemory, in_cuts_from_an_earlier_call) {
    const Options options = refining(Refine::exact);
    const std::vector<double> coordinates = cloud_here(2);
    const Cuts previous = balance(interleaved_points(coordinates, 2), options, MPI_COMM_WORLD).cuts;
    fail_in_balance(options, &previous);
}

}  // namespace
}  // namespace rrcb
