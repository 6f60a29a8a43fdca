// Points, weights and options from any bits: refused, or divided so that look-ups agree.
#include "fuzzing.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/paper.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace {

using rrcb::fuzz::expect;

/// MPI for this process alone, from the first input to the end.
struct Session {
    Session() { MPI_Init(nullptr, nullptr); }
    ~Session() { MPI_Finalize(); }
};

/// Options of RRCB's own method, or of one of the paper's.
struct Request {
    rrcb::Options own;
    std::optional<rrcb::PaperOptions> paper;

    rrcb::Balance divide(const rrcb::Points& points) const {
        return paper ? rrcb::balance_as_in_paper(points, MPI_COMM_SELF, *paper)
                     : rrcb::balance(points, MPI_COMM_SELF, own);
    }
};

Request take_request(rrcb::fuzz::Input& input) {
    using enum rrcb::Refine;
    constexpr std::array refinements = {tolerance, none, tolerance, exact};
    rrcb::Options own;
    own.num_parts = 1 + input.take_below(40);
    const int method = input.take_below(4);
    own.refine = refinements[std::size_t(input.take_below(4))];
    rrcb::PaperOptions paper;
    paper.domain = method == 1 ? rrcb::PaperDomain::sampled : rrcb::PaperDomain::points;
    paper.cut_rule = static_cast<rrcb::CutRule>(input.take_below(2));
    own.expert.cells_per_axis = input.take_below(12);
    own.expert.axes.plain = input.take_below(2) == 1;
    own.imbalance_tolerance = 1 + 0.05 * input.take_below(5);
    own.part_sizes.resize(input.take_below(4) == 0 ? std::size_t(own.num_parts) : 0);
    // Over up to 600 decades, to subnormal numbers.
    const int most_halvings = own.part_sizes.empty() ? 0 : 5 * input.take_below(215);
    for (double& size : own.part_sizes)
        size = std::ldexp(input.take_below(3), -(most_halvings * input.take_below(256) / 255));
    paper.num_parts = own.num_parts;
    paper.part_sizes = own.part_sizes;
    paper.cells_per_axis = std::max(1, own.expert.cells_per_axis);
    paper.plain_cuts = own.expert.axes.plain;
    if (method == 1 || method == 2) return {own, paper};
    return {own, {}};
}

void check(const rrcb::Points& points, const Request& request) {
    const rrcb::Balance result = request.divide(points);
    expect(result.parts.size() == points.count, "a part for each point");
    for (rrcb::LocalIndex i = 0; i < points.count; ++i)
        expect(result.parts[i] == rrcb::part_of(result.cuts, points.position(i)),
               "look-ups find the part");
    expect(request.divide(points).parts == result.parts, "the same parts twice");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Session session;
    rrcb::fuzz::Input input(data, size);
    const Request request = take_request(input);
    const int dimension = 1 + input.take_below(3);
    const bool weighted = input.take_below(2) == 1;
    const auto width = static_cast<std::size_t>(dimension) + (weighted ? 1 : 0);
    const std::size_t count = std::min<std::size_t>(input.size() / (8 * width), 500);
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    std::vector<double> weights(weighted ? count : 0);
    for (double& x : coordinates) x = input.take<double>();
    for (double& w : weights) w = input.take<double>();
    try {
        check(rrcb::Points(coordinates, dimension, weights), request);
    } catch (const rrcb::Error& error) {
        expect(error.code() == rrcb::ErrorCode::invalid_argument, "the caller's mistake");
    }
    return 0;
}
