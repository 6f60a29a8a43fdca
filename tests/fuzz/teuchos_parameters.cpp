// Lists of parameters: taken, or refused with their name. One a line: name, blank, type, value,
// where the type is one of i l d b s.
#include "fuzzing.hpp"

#include <rrcb/error.hpp>
#include <rrcb/teuchos/parameters.hpp>

#include <cmath>
#include <sstream>

namespace {

void set(Teuchos::ParameterList& list, const std::string& name, const std::string& text) {
    const char type = text.empty() ? 's' : text[0];
    const std::string value = text.empty() ? text : text.substr(1);
    if (type == 'i') list.set(name, static_cast<int>(std::strtol(value.c_str(), nullptr, 10)));
    if (type == 'l') list.set(name, std::strtoll(value.c_str(), nullptr, 10));
    if (type == 'd') list.set(name, std::strtod(value.c_str(), nullptr));
    if (type == 'b') list.set(name, value == "1");
    if (type == 's') list.set(name, value);
}

void check(const Teuchos::ParameterList& list) {
    using rrcb::fuzz::expect;
    const rrcb::Options options = rrcb::teuchos::options_from(list);
    expect(options.num_parts >= 0, "parts in range");
    expect(options.expert.cells_per_axis >= 0 && options.expert.cells_per_axis <= 4096,
           "cells in range");
    expect(options.imbalance_tolerance >= 1 && std::isfinite(options.imbalance_tolerance),
           "tolerance in range");
    for (const auto& [name, value] : rrcb::teuchos::zoltan_strings(list))
        expect(list.isParameter(name), "names of the list");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream input{std::string(rrcb::fuzz::text_of(data, size))};
    Teuchos::ParameterList list;
    for (std::string line; std::getline(input, line);) {
        const std::size_t blank = std::min(line.find(' '), line.size());
        if (blank > 0)
            set(list, line.substr(0, blank), line.substr(std::min(blank + 1, line.size())));
    }
    try {
        check(list);
    } catch (const rrcb::Error& error) {
        rrcb::fuzz::expect(error.code() == rrcb::ErrorCode::invalid_argument,
                           "the caller's mistake");
    }
    return 0;
}
