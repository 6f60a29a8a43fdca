// A file of points: read, or refused with the place and the fix.
#include "failure.hpp"
#include "fuzzing.hpp"
#include "points_files.hpp"

#include <cmath>
#include <sstream>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using rrcb::fuzz::expect;
    std::istringstream input{std::string(rrcb::fuzz::text_of(data, size))};
    try {
        const comparisons::Workload workload = comparisons::read_points(input, "points.csv");
        const auto dimension = static_cast<std::size_t>(workload.dimension);
        const std::size_t count = workload.coordinates.size() / dimension;
        expect(dimension == 2 || dimension == 3, "2 or 3 dimensions");
        expect(count > 0 && count * dimension == workload.coordinates.size(), "whole points");
        expect(workload.weights.size() == (workload.weighted ? count : 0), "a weight each");
        for (const double x : workload.coordinates) expect(std::isfinite(x), "finite coordinates");
        for (const double w : workload.weights)
            expect(std::isfinite(w) && w >= 0, "finite weights, not negative");
    } catch (const comparisons::Failure& failure) {
        expect(std::string_view(failure.what()).starts_with("points.csv:"), "the place is named");
    }
    return 0;
}
