#include "../support/common.hpp"

#include <rrcb/error.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/teuchos/parameters.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace rrcb::teuchos {
namespace {

using Teuchos::ParameterList;

template <class Value>
ParameterList list_with(const std::string& name, const Value& value) {
    ParameterList list;
    list.set(name, value);
    return list;
}

std::string message_of(const ParameterList& list) {
    try {
        options_from(list);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        return error.what();
    }
    return "no error";
}

void expect_error(const ParameterList& list, const std::vector<std::string>& pieces) {
    const std::string message = message_of(list);
    for (const std::string& piece : pieces)
        EXPECT_NE(message.find(piece), std::string::npos)
            << "'" << piece << "' is not in: " << message;
}

void expect_defaults(const Options& options) {
    const Options defaults;
    EXPECT_EQ(options.num_parts, defaults.num_parts);
    EXPECT_EQ(options.expert.cells_per_axis, defaults.expert.cells_per_axis);
    EXPECT_EQ(options.refine, defaults.refine);
    EXPECT_EQ(options.expert.coincident, defaults.expert.coincident);
    EXPECT_EQ(options.imbalance_tolerance, defaults.imbalance_tolerance);
}

TEST(Parameters, of_an_empty_or_the_valid_list_are_the_defaults) {
    expect_defaults(options_from(ParameterList()));
    expect_defaults(options_from(*valid_parameters()));
}

TEST(Parameters, of_the_papers_methods_have_the_defaults_of_these) {
    const auto valid = valid_parameters();
    const PaperOptions defaults;
    EXPECT_EQ(valid->get<double>("RRCB_SIGMA_MULTIPLIER"), defaults.sigma_multiplier);
    EXPECT_EQ(valid->get<double>("RRCB_SAMPLE_FRACTION"), defaults.sample_fraction);
    EXPECT_EQ(valid->get<long long>("RRCB_SEED"), static_cast<long long>(defaults.seed));
}

void expect_all_set(const ParameterList& list) {
    const Options options = options_from(list);
    EXPECT_EQ(options.num_parts, 6);
    EXPECT_EQ(options.expert.cells_per_axis, 12);
    EXPECT_EQ(options.refine, Refine::exact);
    EXPECT_EQ(options.imbalance_tolerance, 2.0);
    std::map<std::string, std::string> strings;
    for (const auto& [name, value] : zoltan_strings(list)) strings[name] = value;
    EXPECT_EQ(strings["RRCB_DOMAIN"], "SAMPLED");
    EXPECT_EQ(strings["RRCB_CUT_RULE"], "Midpoint");
    EXPECT_EQ(strings["RRCB_SIGMA_MULTIPLIER"], "0.1");
    EXPECT_EQ(strings["RRCB_SAMPLE_FRACTION"], "0.125");
    EXPECT_EQ(strings["RRCB_SEED"], "5000000000");
}

/// A file that is gone when the test ends.
struct TextFile {
    TextFile(const std::string& ending, const std::string& text)
        : path(testing::TempDir() + "rrcb_parameters_" + std::to_string(getpid()) + ending) {
        std::ofstream(path) << text;
    }
    ~TextFile() { std::filesystem::remove(path); }
    std::string path;
};

TEST(Parameters, are_read_from_xml) {
    const TextFile file(".xml", R"(<ParameterList name="RRCB">
  <Parameter name="NUM_GLOBAL_PARTS" type="int" value="6"/>
  <Parameter name="RRCB_SUPPORT_MESH" type="int" value="12"/>
  <Parameter name="RRCB_DOMAIN" type="string" value="SAMPLED"/>
  <Parameter name="RRCB_CUT_RULE" type="string" value="Midpoint"/>
  <Parameter name="RRCB_REFINE" type="string" value="exact"/>
  <Parameter name="IMBALANCE_TOL" type="int" value="2"/>
  <Parameter name="RRCB_SIGMA_MULTIPLIER" type="double" value="0.1"/>
  <Parameter name="RRCB_SAMPLE_FRACTION" type="double" value="0.125"/>
  <Parameter name="RRCB_SEED" type="long long" value="5000000000"/>
</ParameterList>)");
    expect_all_set(read_parameters(file.path));
}

TEST(Parameters, are_read_from_yaml) {
    const TextFile file(".yaml", R"(RRCB:
  NUM_GLOBAL_PARTS: 6
  RRCB_SUPPORT_MESH: 12
  RRCB_DOMAIN: SAMPLED
  RRCB_CUT_RULE: Midpoint
  RRCB_REFINE: exact
  IMBALANCE_TOL: 2
  RRCB_SIGMA_MULTIPLIER: 0.1
  RRCB_SAMPLE_FRACTION: 1.25e-1
  RRCB_SEED: 5000000000
)");
    expect_all_set(read_parameters(file.path));
}

TEST(Parameters, that_cannot_be_read_name_the_file) {
    const auto fails = [](const std::string& file, const std::string& piece) {
        try {
            read_parameters(file);
            ADD_FAILURE() << file << " was read";
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(file + ": ")) << message;
            EXPECT_NE(message.find(piece), std::string::npos) << message;
        }
    };
    fails("nowhere.yaml", "cannot be opened");
    fails("parameters.txt", "ends in .xml, .yaml or .yml");
    fails("parameters", "ends in .xml, .yaml or .yml");
    const TextFile xml(".xml", "<ParameterList><Parameter");
    fails(xml.path, "is no list of parameters");
    const TextFile yaml(".yml", "RRCB: [1, {2");
    fails(yaml.path, "is no list of parameters");
}

TEST(Parameters, of_an_unknown_name_are_rejected_with_the_names_there_are) {
    expect_error(list_with("RRCB_SEEED", 1),
                 {"unknown parameter 'RRCB_SEEED'", "RRCB_DUMP_WHEN", "; did you mean RRCB_SEED?"});
    ParameterList nested;
    nested.sublist("Inner");
    expect_error(nested, {"unknown parameter 'Inner'"});
}

TEST(Parameters, of_the_wrong_type_are_rejected) {
    expect_error(list_with("RRCB_SUPPORT_MESH", 1.5),
                 {"parameter RRCB_SUPPORT_MESH must not be 1.5 (double)", "from 1 to 4096"});
    expect_error(list_with("RRCB_SUPPORT_MESH", std::string("AUTO")), {"must not be 'AUTO'"});
    expect_error(list_with("RRCB_DOMAIN", 3),
                 {"must not be 3 (int)", "ANALYTIC, SAMPLED or POINTS"});
    expect_error(list_with("RRCB_DUMP", 3), {"must not be 3 (int)", "a string"});
    ParameterList nested;
    nested.sublist("RRCB_SEED");
    expect_error(nested, {"parameter RRCB_SEED must not be a list"});
}

TEST(Parameters, out_of_range_are_rejected) {
    expect_error(list_with("NUM_GLOBAL_PARTS", -1), {"NUM_GLOBAL_PARTS must not be -1"});
    for (const int cells : {-1, 4097})
        expect_error(list_with("RRCB_SUPPORT_MESH", cells), {"4096"});
    for (const double fraction : {0.0, -1.0, 1.0000001})
        expect_error(list_with("RRCB_SAMPLE_FRACTION", fraction), {"above 0, at most 1"});
    expect_error(list_with("RRCB_SIGMA_MULTIPLIER", 0.0), {"above 0"});
    expect_error(list_with("IMBALANCE_TOL", 0.99), {"1 or more"});
    expect_error(list_with("RRCB_SEED", -1), {"0 or more"});
    for (const char* name : {"IMBALANCE_TOL", "RRCB_SAMPLE_FRACTION", "RRCB_SIGMA_MULTIPLIER"}) {
        expect_error(list_with(name, std::numeric_limits<double>::quiet_NaN()), {"nan"});
        expect_error(list_with(name, std::numeric_limits<double>::infinity()), {"inf"});
    }
    expect_error(list_with("RRCB_REFINE", std::string("MORE")),
                 {"must not be 'MORE'", "NONE, TOLERANCE or EXACT"});
}

TEST(Parameters, become_strings_for_zoltan_only_where_they_are_set) {
    EXPECT_TRUE(zoltan_strings(ParameterList()).empty());
    ParameterList list;
    list.set("RRCB_SUPPORT_MESH", 0);
    list.set("RRCB_SEED", 7);
    list.set("RRCB_SIGMA_MULTIPLIER", 0.1);
    list.set("IMBALANCE_TOL", 2);
    list.set("RRCB_DOMAIN", "sampled");
    list.set("RRCB_DUMP", "Here/There");
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"RRCB_SUPPORT_MESH", "DEFAULT"}, {"RRCB_SEED", "7"},
        {"RRCB_SIGMA_MULTIPLIER", "0.1"}, {"IMBALANCE_TOL", "2"},
        {"RRCB_DOMAIN", "sampled"},       {"RRCB_DUMP", "Here/There"}};
    EXPECT_EQ(zoltan_strings(list), expected);
    list.set("RRCB_SEED", "seven");
    EXPECT_THROW(zoltan_strings(list), Error);
}

TEST(Parameters, of_rows_of_numbers_are_strings) {
    ParameterList list;
    list.set("RRCB_MIN_WIDTH", "0.1 0.2");
    list.set("RRCB_GRID", "0 0.05, -1 0.05");
    const Options options = options_from(list);
    EXPECT_EQ(options.expert.axes.min_width, (std::vector<double>{0.1, 0.2}));
    ASSERT_EQ(options.expert.axes.grid.size(), 2u);
    EXPECT_EQ(options.expert.axes.grid[1].origin, -1);
    EXPECT_EQ(options.expert.axes.grid[1].spacing, 0.05);
    EXPECT_TRUE(options_from(ParameterList()).expert.axes.grid.empty());
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"RRCB_MIN_WIDTH", "0.1 0.2"}, {"RRCB_GRID", "0 0.05, -1 0.05"}};
    EXPECT_EQ(zoltan_strings(list), expected);
    expect_error(list_with("RRCB_MIN_WIDTH", 0.1),
                 {"must not be 0.1 (double)", "NONE, or a number"});
    expect_error(list_with("RRCB_MIN_WIDTH", std::string("0.1 -1")), {"must not be '0.1 -1'"});
    expect_error(list_with("RRCB_GRID", std::string("0 1 2")),
                 {"must not be '0 1 2'", "an origin and a spacing above 0 for each axis"});
}

TEST(Parameters, are_all_documented) {
    const auto valid = valid_parameters();
    std::ostringstream printed;
    valid->print(printed, ParameterList::PrintOptions().showDoc(true).showTypes(true));
    int count = 0;
    for (auto entry = valid->begin(); entry != valid->end(); ++entry, ++count) {
        EXPECT_FALSE(valid->entry(entry).docString().empty()) << valid->name(entry);
        EXPECT_NE(printed.str().find(valid->name(entry)), std::string::npos);
    }
    EXPECT_EQ(count, 18);
    EXPECT_NE(printed.str().find("points drawn per real point"), std::string::npos)
        << printed.str();
}

}  // namespace
}  // namespace rrcb::teuchos
