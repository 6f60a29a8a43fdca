#pragma once

#include "case_mpi.hpp"

#include <functional>
#include <string>

namespace rrcb::test {

/// What is wrong with the answer to a case, as this rank sees it; empty: nothing. Collective.
using Property = std::function<std::string(const Case&)>;

/// Counterexample that rapidcheck ends with, and its text; empty where every case holds.
struct Verdict {
    std::string text;
    Case smallest;
};

/// Checks a property on generated cases. Collective over MPI_COMM_WORLD.
///
/// Rank 0 generates and shrinks; every case goes to all ranks, which judge it together: it fails
/// when it fails on one. The seed is 1 and there are `num_cases` unless RC_PARAMS says otherwise.
Verdict find_counterexample(const std::string& name, const Property& property, int num_cases);

/// The same as an expectation of GoogleTest, on rank 0, which prints seed and counterexample.
void expect_for_all_cases(const Property& property, int num_cases);

}  // namespace rrcb::test
