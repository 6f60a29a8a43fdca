// Parameters of the plug-in, one a line: name, blank, value. Whatever they say, the options stay
// legal.
#include "zoltan/handle/parameters.hpp"

#include "fuzzing.hpp"

#include <cmath>
#include <string>

namespace {

void expect_legal(const rrcb::zoltan::Parameters& parameters) {
    using rrcb::fuzz::expect;
    const rrcb::Options& options = parameters.options;
    expect(options.expert.cells_per_axis >= 0 && options.expert.cells_per_axis <= 4096,
           "cells in range");
    expect(options.imbalance_tolerance >= 1 && std::isfinite(options.imbalance_tolerance),
           "tolerance in range");
    expect(parameters.sigma_multiplier > 0 && std::isfinite(parameters.sigma_multiplier),
           "multiplier in range");
    expect(parameters.sample_fraction > 0 && parameters.sample_fraction <= 1, "fraction in range");
    expect(parameters.num_gid_entries >= 1 && parameters.num_lid_entries >= 0, "widths of ids");
    expect(parameters.weight_dimension >= 0, "number of weights");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace rrcb::zoltan;
    std::string text(rrcb::fuzz::text_of(data, size));
    Parameters parameters;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string line = text.substr(0, end);
        text.erase(0, end + 1);
        const std::size_t blank = std::min(line.find(' '), line.size());
        const std::string name = clean(line.substr(0, blank).c_str());
        const std::string value = line.substr(std::min(blank + 1, line.size()));
        if (set_own(parameters, name, value.c_str()) == Setting::unknown)
            note_common(parameters, name, clean(value.c_str()));
        expect_legal(parameters);
    }
    return 0;
}
