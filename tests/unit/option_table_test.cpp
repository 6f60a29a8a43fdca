#include "options/option_table.hpp"

#include "../support/common.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"

#include <rrcb/error.hpp>

#include <cctype>
#include <fstream>
#include <sstream>

namespace rrcb {
namespace {

/// An option by its name in Options.
const Option& named(std::string_view name) {
    const Option* option = find_option(name);
    if (option == nullptr) throw Error(ErrorCode::internal, "no option " + std::string(name));
    return *option;
}

bool reads(std::string_view name, std::string_view text) {
    Options options;
    return read_option(named(name), text, options);
}

/// What the check of options says of these; empty when they are legal.
template <class Change>
std::string complaint(Change&& change, int dimension = 2) {
    Options options{.num_parts = 4};
    change(options);
    try {
        check_options(options, dimension);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(OptionTable, is_searched_by_the_name_of_an_option_or_of_a_parameter) {
    EXPECT_EQ(find_option("refine"), find_parameter("RRCB_REFINE"));
    EXPECT_EQ(find_option("imbalance_tolerance"), find_parameter("IMBALANCE_TOL"));
    EXPECT_EQ(find_option("colour"), nullptr);
    EXPECT_EQ(find_parameter(""), nullptr);
    EXPECT_EQ(find_option(""), nullptr);
}

TEST(OptionTable, suggests_the_names_nearest_to_an_unknown_one) {
    const auto nearest = [](std::string_view given) { return suggestion(given, option_names()); };
    EXPECT_EQ(nearest("tolerance"), "; did you mean imbalance_tolerance?");
    EXPECT_EQ(nearest("Imbalance_tolerence"), "; did you mean imbalance_tolerance?");
    EXPECT_EQ(nearest("tolerence"), "; did you mean imbalance_tolerance?");
    EXPECT_EQ(nearest("refine_mode"), "; did you mean refine?");
    EXPECT_EQ(nearest("min_width"), "; did you mean axes.min_width?");
    EXPECT_EQ(nearest("parts"), "; did you mean num_parts or max_root_parts?");
    EXPECT_EQ(nearest("reine"), "; did you mean refine?");
    EXPECT_EQ(nearest("colour") + nearest("") + nearest("xyz"), "");
}

TEST(OptionTable, writes_what_it_reads) {
    const std::vector<std::pair<std::string_view, std::vector<std::string>>> texts = {
        {"num_parts", {"AUTO", "1", "2147483647"}},
        {"cells_per_axis", {"AUTO", "1", "4096"}},
        {"refine", {"NONE", "TOLERANCE", "EXACT"}},
        {"coincident", {"TOGETHER", "DIVIDE"}},
        {"imbalance_tolerance", {"1", "1.01", "1e+300"}},
        {"max_root_parts", {"2", "64", "2147483647"}},
        {"tree.group_size", {"AUTO", "1", "12"}},
        {"tree.larger_below", {"OFF", "ON"}},
        {"tree.round_robin_block", {"0", "2"}},
        {"axes.plain", {"OFF", "ON"}},
        {"axes.min_width", {"NONE", "0.1", "0.1 1e-300 5e-324"}},
        {"axes.grid", {"NONE", "0 0.05", "-1.5 0.25, 1e+300 7, 0 1"}}};
    for (const auto& [name, values] : texts) {
        for (const std::string& value : values) {
            Options options;
            ASSERT_TRUE(read_option(named(name), value, options)) << name << '=' << value;
            EXPECT_EQ(write_option(named(name), options), value) << name;
        }
    }
}

TEST(OptionTable, reads_words_in_any_case) {
    Options options;
    EXPECT_TRUE(read_option(named("refine"), "exact", options));
    EXPECT_EQ(options.refine, Refine::exact);
    EXPECT_TRUE(read_option(named("cells_per_axis"), "auto", options));
    EXPECT_FALSE(reads("refine", "exactly"));
    EXPECT_FALSE(reads("refine", ""));
}

TEST(OptionTable, reads_0_as_auto) {
    for (const char* name : {"num_parts", "cells_per_axis", "tree.group_size"}) {
        Options options;
        options.num_parts = options.expert.cells_per_axis = options.expert.tree.group_size = 7;
        EXPECT_TRUE(read_option(named(name), "0", options)) << name;
        EXPECT_EQ(write_option(named(name), options), "AUTO");
    }
    EXPECT_EQ(texts_of(named("num_parts")),
              "a whole number, 1 or more, or 0 or AUTO for one part per rank");
}

TEST(OptionTable, reads_no_number_beyond_its_range_and_leaves_the_value) {
    for (const char* text : {"-0.5", "-1", "4097", "1.5", "8X", "", "99999999999"})
        EXPECT_FALSE(reads("cells_per_axis", text)) << text;
    for (const char* text : {"0", "1", "-2", "2.5", "AUTO", "2147483648"})
        EXPECT_FALSE(reads("max_root_parts", text)) << text;
    for (const char* text : {"0.99", "nan", "inf"})
        EXPECT_FALSE(reads("imbalance_tolerance", text)) << text;
    EXPECT_FALSE(reads("part_sizes", "1"));
    Options options;
    read_option(named("max_root_parts"), "1", options);
    EXPECT_EQ(options.expert.max_root_parts, Options{}.expert.max_root_parts);
}

TEST(OptionTable, reads_rows_of_numbers_with_blanks_or_commas_between_them) {
    Options options;
    EXPECT_TRUE(read_option(named("axes.min_width"), " 1,2 ,\t3 ", options));
    EXPECT_EQ(options.expert.axes.min_width, (std::vector<double>{1, 2, 3}));
    EXPECT_TRUE(read_option(named("axes.grid"), "0.5 1 -2 3E-1", options));
    ASSERT_EQ(options.expert.axes.grid.size(), 2u);
    EXPECT_EQ(options.expert.axes.grid[1].origin, -2);
    EXPECT_EQ(options.expert.axes.grid[1].spacing, 0.3);
    for (const char* text : {"", " ", "0", "-1", "nan", "inf", "1 2 3 4", "1;2", "1x", "1 two"})
        EXPECT_FALSE(reads("axes.min_width", text)) << text;
    for (const char* text : {"", "1", "0 0", "0 -1", "nan 1", "0 inf", "0 1 0", "0 1 0 1 0 1 0 1"})
        EXPECT_FALSE(reads("axes.grid", text)) << text;
    EXPECT_TRUE(read_option(named("axes.grid"), "none", options));
    EXPECT_TRUE(options.expert.axes.grid.empty());
    EXPECT_FALSE(options.expert.axes.min_width.empty());
}

TEST(Check, refuses_limits_of_cuts_that_are_no_lengths_or_not_one_per_axis) {
    const std::string one_each =
        "axes.min_width must hold one number per axis of the points, or be empty";
    const auto width = [](std::vector<double> widths, int dimension) {
        return complaint([&](Options& o) { o.expert.axes.min_width = widths; }, dimension);
    };
    EXPECT_EQ(width({1, 2}, 2) + width({5e-324}, 1) + width({1e308, 1, 1}, 3), "");
    EXPECT_EQ(width({1}, 2), one_each);
    EXPECT_EQ(width({1, 1, 1}, 2), one_each);
    for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL})
        EXPECT_EQ(width({1, value}, 2), "axes.min_width must be finite and above 0");
    const auto grid = [](std::vector<GridLines> lines, int dimension) {
        return complaint([&](Options& o) { o.expert.axes.grid = lines; }, dimension);
    };
    EXPECT_EQ(grid({{0, 1}, {-1e308, 1e-300}}, 2), "");
    EXPECT_EQ(grid({{0, 1}}, 3),
              "axes.grid must hold the lines across each axis of the points, or be empty");
    for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL})
        EXPECT_EQ(grid({{0, value}}, 1),
                  "axes.grid must have finite origins, and spacings that are finite and above 0");
    EXPECT_NE(grid({{HUGE_VAL, 1}}, 1), "");
}

TEST(Check, refuses_what_lies_beyond_the_range_of_an_option_and_tells_the_range) {
    EXPECT_EQ(complaint([](Options&) {}), "");
    EXPECT_EQ(complaint([](Options& o) { o.expert.tree.group_size = -1; }),
              "tree.group_size must be positive, or 0 for the parts of each machine");
    EXPECT_EQ(complaint([](Options& o) { o.num_parts = -1; }),
              "num_parts must be positive, or 0 for one part per rank");
    for (const int dimension : {1, 2, 3}) {
        const int most = dimension < 3 ? 4096 : 256;
        const auto mesh = [&](int cells) {
            return complaint([&](Options& o) { o.expert.cells_per_axis = cells; }, dimension);
        };
        EXPECT_EQ(mesh(0) + mesh(1) + mesh(most), "");
        const std::string refusal = "cells_per_axis must be 1 ... " + std::to_string(most) +
                                    " cells per axis, or 0 for the default";
        EXPECT_EQ(mesh(most + 1), refusal);
        EXPECT_EQ(mesh(-1), refusal);
    }
    for (const double value : {0.99, std::nan(""), HUGE_VAL})
        EXPECT_EQ(complaint([&](Options& o) { o.imbalance_tolerance = value; }),
                  "imbalance_tolerance must be finite and at least 1");
    EXPECT_EQ(complaint([](Options& o) { o.imbalance_tolerance = 1e308; }), "");
}

TEST(OptionTable, tells_what_each_option_may_be) {
    EXPECT_EQ(legal_values(named("imbalance_tolerance")), "a number, 1 or more");
    EXPECT_EQ(legal_values(named("cells_per_axis")), "a whole number from 1 to 4096");
    EXPECT_EQ(legal_values(named("axes.min_width")),
              "NONE, or a number above 0 for each axis: 0.1 0.1");
    EXPECT_EQ(legal_values(named("part_sizes")), "a list");
    EXPECT_EQ(legal_values(named("refine")), "NONE, TOLERANCE or EXACT");
    EXPECT_EQ(documentation(named("num_parts")),
              "Parts to make: a whole number, 1 or more; 0: one part per rank.");
}

TEST(Request, differs_in_every_option_by_its_name) {
    using Change = void (*)(Options&);
    const std::vector<std::pair<std::string_view, Change>> changes = {
        {"num_parts", [](Options& o) { o.num_parts = 3; }},
        {"part_sizes", [](Options& o) { o.part_sizes = {1}; }},
        {"cells_per_axis", [](Options& o) { o.expert.cells_per_axis = 3; }},
        {"tree.group_size", [](Options& o) { o.expert.tree.group_size = 2; }},
        {"tree.larger_below", [](Options& o) { o.expert.tree.larger_below = true; }},
        {"tree.round_robin_block", [](Options& o) { o.expert.tree.round_robin_block = 1; }},
        {"axes.plain", [](Options& o) { o.expert.axes.plain = true; }},
        {"one of axes.order, axes.min_width, axes.grid",
         [](Options& o) { o.expert.axes.order = AxisOrder::given({1}); }},
        {"one of axes.order, axes.min_width, axes.grid",
         [](Options& o) { o.expert.axes.order = AxisOrder::grouped({1}); }},
        {"one of axes.order, axes.min_width, axes.grid",
         [](Options& o) { o.expert.axes.order = AxisOrder::among({1}); }},
        {"axes.order", [](Options& o) { o.expert.axes.order = AxisOrder::longest(); }},
        {"one of axes.order, axes.min_width, axes.grid",
         [](Options& o) { o.expert.axes.min_width = {1}; }},
        {"one of axes.order, axes.min_width, axes.grid",
         [](Options& o) {
             o.expert.axes.grid = {{0, 1}};
         }},
        {"refine", [](Options& o) { o.refine = Refine::none; }},
        {"coincident", [](Options& o) { o.expert.coincident = Coincident::divide; }},
        {"imbalance_tolerance", [](Options& o) { o.imbalance_tolerance = 2; }},
        {"max_root_parts", [](Options& o) { o.expert.max_root_parts = 2; }}};
    const Request reference = request_of({}, 2, nullptr);
    EXPECT_EQ(first_difference(reference, request_of({}, 2, nullptr)), std::nullopt);
    for (const auto& [name, change] : changes) {
        Options options;
        change(options);
        const auto index = first_difference(reference, request_of(options, 2, nullptr));
        ASSERT_TRUE(index) << name;
        EXPECT_EQ(name_of_request(*index), name);
    }
    const Cuts previous{1, 2, {Cut{}}};
    EXPECT_EQ(name_of_request(*first_difference(reference, request_of({}, 2, &previous))),
              "previous");
    EXPECT_EQ(name_of_request(*first_difference(reference, request_of({}, 3, nullptr))),
              "dimension");
}

/// Returns the text as the middle of a sentence has it: a word of capitals stays one.
std::string continued(std::string_view text) {
    std::string result(text);
    const bool is_name = result.size() > 1 && std::isupper(static_cast<unsigned char>(result[1]));
    if (!is_name)
        result[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(result[0])));
    return result;
}

/// Marks the words of the interface, which have capitals only, as code.
std::string with_code_marks(const std::string& text) {
    const auto is_capital = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_' || c == '='; };
    std::string marked;
    for (auto at = text.begin(); at != text.end();) {
        const auto end = std::find_if_not(at, text.end(), is_capital);
        const std::string word(at, end);
        const bool is_code = (word.size() > 3 && word != "RRCB") || word == "ON" || word == "OFF";
        marked += is_code ? '`' + word + '`' : word;
        at = std::find_if(end, text.end(), is_capital);
        marked.append(end, at);
    }
    return marked;
}

std::string values_of(const Option& option, const Choice& choice, const Options& first) {
    const std::string front = write_option(option, first);
    std::string text = '`' + front + '`';
    for (const Word& word : choice)
        if (word.word != front) text += ", `" + std::string(word.word) + '`';
    return text;
}

std::string values_of(const Option& option, const Rows& rows, const Options& first) {
    return '`' + write_option(option, first) + "`, " + rows.text + ": `" + rows.example + '`';
}

template <class Number>
std::string values_of(const Option& option, const Range<Number>& range, const Options& first) {
    const std::string value = write_option(option, first);
    std::string text = value == "AUTO" ? "`AUTO`" : value;
    const std::string legal = legal_values(option);
    const std::size_t above = legal.find("above");
    text += ", " + legal.substr(above != legal.npos ? above : legal.find_first_of("0123456789"));
    if (range.most_in_3d != range.most) {
        std::ostringstream most;
        most << " (" << range.most_in_3d << " in 3-D)";
        text += most.str();
    }
    return text;
}

std::string meanings(const Choice& choice) {
    std::string text;
    for (const Word& word : choice) text += std::string("; ") + word.word + ": " + word.text;
    return text;
}

template <class Number>
std::string meanings(const Range<Number>& range) {
    return range.zero != nullptr ? std::string("; AUTO: ") + range.zero : "";
}

std::string meanings(const Rows&) {
    return "";
}

/// Returns the row of an option in the table of the document: its parameter, its values with that
/// of `first` in front, and what it sets.
std::string table_row(const Option& option, const Options& first) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) -> std::string {
        if constexpr (std::is_same_v<Kind, Lists>)
            return "";
        else
            return "| `" + std::string(option.parameter) + "` | " + values_of(option, kind, first) +
                   " | " + with_code_marks(continued(option.text) + meanings(kind)) + " |";
    });
}

TEST(OptionTable, is_the_table_of_the_document) {
    std::ifstream file(RRCB_DOCUMENT);
    ASSERT_TRUE(file) << RRCB_DOCUMENT;
    std::ostringstream document;
    document << file.rdbuf();
    Options plug_in;  // whose handles divide points in one place, as RCB
    plug_in.expert.coincident = Coincident::divide;
    for (const Option& option : option_table) {
        if (!std::string_view(option.parameter).starts_with("RRCB_")) continue;
        const std::string row = table_row(option, plug_in);
        EXPECT_NE(document.str().find('\n' + row + '\n'), std::string::npos)
            << "not a line of " << RRCB_DOCUMENT << ":\n"
            << row;
    }
}

}  // namespace
}  // namespace rrcb
