// Points, weights and options from any bits: refused, or divided so that look-ups agree.
#include "fuzzing.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <vector>

namespace {

using rrcb::fuzz::expect;

/// MPI for this process alone, from the first input to the end.
struct Session {
    Session() { MPI_Init(nullptr, nullptr); }
    ~Session() { MPI_Finalize(); }
};

rrcb::Options take_options(rrcb::fuzz::Input& input) {
    rrcb::Options options;
    options.num_parts = 1 + input.take_below(40);
    options.domain = static_cast<rrcb::DomainKind>(input.take_below(4));
    options.refine = static_cast<rrcb::Refine>(input.take_below(4));
    options.cut_rule = static_cast<rrcb::CutRule>(input.take_below(2));
    options.support_mesh = input.take_below(12);
    options.plain_cuts = input.take_below(2) == 1;
    options.imbalance_tolerance = 1 + 0.05 * input.take_below(5);
    options.part_sizes.resize(input.take_below(4) == 0 ? std::size_t(options.num_parts) : 0);
    for (double& size : options.part_sizes) size = input.take_below(3);
    return options;
}

void check(const rrcb::Points& points, const rrcb::Options& options) {
    const rrcb::Balance result = rrcb::balance(points, options, MPI_COMM_SELF);
    expect(result.parts.size() == points.count, "a part for each point");
    for (rrcb::LocalIndex i = 0; i < points.count; ++i)
        expect(result.parts[i] == rrcb::part_of(result.cuts, points.position(i)),
               "look-ups find the part");
    const rrcb::Balance again = rrcb::balance(points, options, MPI_COMM_SELF);
    expect(again.parts == result.parts, "the same parts twice");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Session session;
    rrcb::fuzz::Input input(data, size);
    const rrcb::Options options = take_options(input);
    const int dimension = 1 + input.take_below(3);
    const bool weighted = input.take_below(2) == 1;
    const auto width = static_cast<std::size_t>(dimension) + (weighted ? 1 : 0);
    const std::size_t count = std::min<std::size_t>(input.size() / (8 * width), 500);
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    std::vector<double> weights(weighted ? count : 0);
    for (double& x : coordinates) x = input.take<double>();
    for (double& w : weights) w = input.take<double>();
    try {
        check(rrcb::interleaved_points(coordinates, dimension, weights), options);
    } catch (const rrcb::Error& error) {
        expect(error.code() == rrcb::ErrorCode::invalid_argument, "the caller's mistake");
    }
    return 0;
}
