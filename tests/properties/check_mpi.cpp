#include "check_mpi.hpp"

#include "case_generator.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <sstream>

namespace rrcb::test {

namespace {

int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

/// The text of the lowest rank that has one, on every rank. Collective.
std::string first_text(std::string text, MPI_Comm comm) {
    int speaker = text.empty() ? std::numeric_limits<int>::max() : rank_of(comm);
    MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, comm);
    if (speaker == std::numeric_limits<int>::max()) return {};
    auto size = static_cast<int>(text.size());
    MPI_Bcast(&size, 1, MPI_INT, speaker, comm);
    text.resize(static_cast<std::size_t>(size));
    MPI_Bcast(text.data(), size, MPI_CHAR, speaker, comm);
    return "rank " + std::to_string(speaker) + ": " + text;
}

std::string judge_together(const Property& property, const Case& input) {
    std::string text;
    try {
        text = property(input);
    } catch (const std::exception& error) {
        text = std::string("throws: ") + error.what();
    }
    return first_text(std::move(text), MPI_COMM_WORLD);
}

/// Rank 0 tells whether a case follows.
bool announce(bool another) {
    int word = another ? 1 : 0;
    MPI_Bcast(&word, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return word != 0;
}

void follow(const Property& property) {
    while (announce(false)) {
        Case input;
        broadcast(input, MPI_COMM_WORLD);
        judge_together(property, input);
    }
}

rc::detail::TestParams parameters_for(int num_cases) {
    if (std::getenv("RC_PARAMS") != nullptr) return rc::detail::configuration().testParams;
    rc::detail::TestParams parameters;
    parameters.seed = 1;
    parameters.maxSuccess = num_cases;
    return parameters;
}

/// Rank 0's side: the cases in the order in which rapidcheck asks for them.
Verdict lead(const std::string& name, const Property& property, int num_cases) {
    const rc::detail::TestParams parameters = parameters_for(num_cases);
    Verdict verdict;
    const auto testable = [&] {
        Case input = *any_case();
        announce(true);
        broadcast(input, MPI_COMM_WORLD);
        const std::string text = judge_together(property, input);
        if (text.empty()) return;
        verdict.smallest = input;
        RC_FAIL(text);
    };
    const auto result =
        rc::detail::checkTestable(testable, rc::detail::TestMetadata{name, name}, parameters);
    announce(false);
    if (result.is<rc::detail::SuccessResult>()) return verdict;
    std::ostringstream text;
    text << name << ", seed " << parameters.seed << ":\n";
    rc::detail::printResultMessage(result, text);
    verdict.text = text.str();
    return verdict;
}

}  // namespace

Verdict find_counterexample(const std::string& name, const Property& property, int num_cases) {
    if (rank_of(MPI_COMM_WORLD) == 0) return lead(name, property, num_cases);
    follow(property);
    return {};
}

void expect_for_all_cases(const Property& property, int num_cases) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const Verdict verdict = find_counterexample(test->name(), property, num_cases);
    EXPECT_TRUE(verdict.text.empty()) << verdict.text;
}

}  // namespace rrcb::test
