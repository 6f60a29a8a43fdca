#include <rrcb/rrcb.h>
#include <rrcb/version.hpp>

#include <gtest/gtest.h>
#include <regex.h>

#include <string>

namespace rrcb {
namespace {

#if !RRCB_VERSION_GE(0, 1, 0) || RRCB_VERSION_GE(1000, 0, 0)
#error "RRCB_VERSION_GE does not compare in the preprocessor"
#endif

TEST(Version, macros_agree_with_the_project) {
    EXPECT_STREQ(RRCB_VERSION_STRING, RRCB_EXPECTED_VERSION);
    // A candidate of a release has a suffix: 1.0.0-rc1.
    const std::string expected = RRCB_EXPECTED_VERSION;
    EXPECT_EQ(std::to_string(RRCB_VERSION_MAJOR) + '.' + std::to_string(RRCB_VERSION_MINOR) + '.' +
                  std::to_string(RRCB_VERSION_PATCH),
              expected.substr(0, expected.find('-')));
    EXPECT_STREQ(version(), RRCB_EXPECTED_VERSION);
    EXPECT_STREQ(rrcb_version(), RRCB_EXPECTED_VERSION);
}

TEST(Version, comparison_looks_at_the_numbers_in_their_order) {
    constexpr int major = RRCB_VERSION_MAJOR;
    constexpr int minor = RRCB_VERSION_MINOR;
    constexpr int patch = RRCB_VERSION_PATCH;
    EXPECT_TRUE(RRCB_VERSION_GE(major, minor, patch));
    EXPECT_FALSE(RRCB_VERSION_GE(major, minor, patch + 1));
    EXPECT_FALSE(RRCB_VERSION_GE(major, minor + 1, 0));
    EXPECT_FALSE(RRCB_VERSION_GE(major + 1, 0, 0));
    EXPECT_TRUE(RRCB_VERSION_GE(major, minor - 1, patch + 9));
    EXPECT_TRUE(RRCB_VERSION_GE(major - 1, minor + 9, patch + 9));
}

TEST(Version, build_info_names_commit_compiler_mpi_and_options) {
    const char* lines = "^version: " RRCB_EXPECTED_VERSION
                        "\ncommit: (unknown|[0-9a-f]{12})\n"
                        "compiler: [A-Z][A-Za-z]+ [0-9.]+\nMPI: .*[0-9.]+.*\noptions: .*\n$";
    regex_t compiled;
    ASSERT_EQ(regcomp(&compiled, lines, REG_EXTENDED), 0);
    EXPECT_EQ(regexec(&compiled, build_info(), 0, nullptr, 0), 0) << build_info();
    regfree(&compiled);
    EXPECT_STREQ(rrcb_build_info(), build_info());
}

}  // namespace
}  // namespace rrcb
