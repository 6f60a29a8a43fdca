#pragma once

#include "options/axis_order.hpp"

#include <rrcb/options.hpp>

#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// Describes each option once. The checks, the comparison between ranks, the parameters of the
// plug-in, the list for Teuchos and the table of docs/parameters.md are derived from this table. It
// must be valid C++17, because the header of Teuchos' validators is not valid C++20.

namespace rrcb {

/// Access to a member of Options or of a struct in it.
template <class Value>
struct Field {
    Value (*get)(const Options&);
    void (*set)(Options&, Value);
};

template <auto... path>
struct Member {
    using Value = std::decay_t<decltype((std::declval<Options&>().*....*path))>;

    static Value get(const Options& options) { return (options.*....*path); }
    static void set(Options& options, Value value) { (options.*....*path) = value; }
};

/// The member at the end of a path: field<&Options::expert, &ExpertOptions::cells_per_axis>.
template <auto... path>
inline constexpr Field<typename Member<path...>::Value> field{Member<path...>::get,
                                                              Member<path...>::set};

/// Values of an option that is a number.
template <class Number>
struct Range {
    Field<Number> field;
    Number least;
    Number most;
    bool above_least = false;    ///< whether `least` itself is illegal
    Number most_in_3d = most;    ///< largest value in 3-D
    const char* unit = "";       ///< unit, written after a number
    const char* zero = nullptr;  ///< meaning of 0, if 0 is legal although it is outside the range
};

/// A named value of an option.
struct Word {
    const char* word;
    int value;
    const char* text;  ///< explains the value
};

/// Values of an option that is an enumeration.
struct Choice {
    const Word* words;
    std::size_t num_words;
    int (*get)(const Options&);
    void (*set)(Options&, int);

    const Word* begin() const { return words; }
    const Word* end() const { return words + num_words; }
};

/// Checks an option whose legal values depend on others; throws Error that names it. `options` must
/// already have the number of parts.
using Check = void (*)(const Options& options, int dimension);

/// Values of one option, or of several that belong together, which cannot be written as text.
struct Lists {
    std::vector<double> (*get)(const Options&);  ///< values that ranks compare
    Check check;
};

/// Values of an option with several numbers for each axis. As text they are NONE, or a row of
/// numbers for each axis. Ranks compare them as part of Lists.
struct Rows {
    std::vector<double> (*get)(const Options&);
    Check check;
    /// returns false if the numbers are illegal
    bool (*set)(Options&, const std::vector<double>& numbers);
    std::size_t row_length;
    const char* text;  ///< explains the numbers of a row
    const char* example;
};

struct Option {
    const char* name;  ///< name in Options and in errors; empty if an earlier entry has the same
                       ///< member
    const char* parameter;  ///< name in the plug-in and in Teuchos' list; empty if it is in neither
    const char* text;       ///< explains the effect of the option
    std::variant<Range<int>, Range<double>, Choice, Lists, Rows> kind;
};

inline constexpr Word refine_words[] = {
    {"NONE", static_cast<int>(Refine::none), "the estimate stands"},
    {"TOLERANCE", static_cast<int>(Refine::tolerance),
     "until the imbalance is within IMBALANCE_TOL"},
    {"EXACT", static_cast<int>(Refine::exact), "to the weighted median"}};

inline constexpr Word coincident_words[] = {
    {"TOGETHER", static_cast<int>(Coincident::together), "share a part"},
    {"DIVIDE", static_cast<int>(Coincident::divide),
     "are divided by number, if cuts are refined and not plain"}};

inline constexpr Word switch_words[] = {{"OFF", 0, "no"}, {"ON", 1, "yes"}};

inline constexpr Word machine_words[] = {{"OFF", 0, "no, the number of parts is halved"},
                                         {"ON", 1, "yes"}};

inline constexpr Word axis_rule_words[] = {
    {"FEWEST", 0, "the axis with the least weight near the cut, as estimated"},
    {"LONGEST", 1, "its longest axis"}};

/// Returns 1 for longest(); 0 for all other orders, including those that no word stands for.
inline int axis_rule_of(const Options& options) {
    return is_longest(options.expert.axes.order) ? 1 : 0;
}

inline void set_axis_rule(Options& options, int value) {
    options.expert.axes.order = value == 0 ? AxisOrder::fewest_ghosts() : AxisOrder::longest();
}

inline int machines_of(const Options& options) {
    return options.expert.tree.group_size == 0 ? 1 : 0;
}

inline void set_machines(Options& options, int value) {
    options.expert.tree.group_size = 1 - value;
}

template <auto... path>
int value_of(const Options& options) {
    return static_cast<int>(Member<path...>::get(options));
}

template <auto... path>
void set_value(Options& options, int value) {
    Member<path...>::set(options, static_cast<typename Member<path...>::Value>(value));
}

/// Makes the Choice for an enumeration or a bool at the end of a path.
template <auto... path, std::size_t num_words>
constexpr Choice choice_of(const Word (&words)[num_words]) {
    return {words, num_words, value_of<path...>, set_value<path...>};
}

std::vector<double> values_of_part_sizes(const Options& options);
void check_part_sizes(const Options& options, int dimension);

std::vector<double> values_of_tree(const Options& options);
void check_tree_options(const Options& options, int dimension);

std::vector<double> min_width_of(const Options& options);
bool set_min_width(Options& options, const std::vector<double>& numbers);
void check_min_width(const Options& options, int dimension);

std::vector<double> grid_of(const Options& options);
bool set_grid(Options& options, const std::vector<double>& numbers);
void check_grid(const Options& options, int dimension);

/// All options.
inline constexpr Option option_table[] = {
    {"num_parts", "NUM_GLOBAL_PARTS", "Parts to make",
     Range<int>{field<&Options::num_parts>, 1, std::numeric_limits<int>::max(), false,
                std::numeric_limits<int>::max(), "", "one part per rank"}},
    {"part_sizes", "", "Relative weight of each part",
     Lists{values_of_part_sizes, check_part_sizes}},
    {"cells_per_axis", "RRCB_SUPPORT_MESH", "Cells per axis of each rank's support mesh",
     Range<int>{field<&Options::expert, &ExpertOptions::cells_per_axis>, 1, 4096, false, 256,
                " cells per axis", "as many as suit the points of the rank"}},
    {"tree.group_size", "", "Consecutive parts in a group, all of which are parts of one node",
     Range<int>{field<&Options::expert, &ExpertOptions::tree, &TreeShape::group_size>, 1,
                std::numeric_limits<int>::max(), false, std::numeric_limits<int>::max(), "",
                "the parts of each machine"}},
    {"", "RRCB_MACHINES", "Whether whole machines are cut off first, if machines are alike",
     Choice{machine_words, std::size(machine_words), machines_of, set_machines}},
    {"tree.larger_below", "", "Whether the larger half of an odd number of parts is below a cut",
     choice_of<&Options::expert, &ExpertOptions::tree, &TreeShape::larger_below>(switch_words)},
    {"tree.round_robin_block", "",
     "Consecutive parts that go to a group before the next gets its own",
     Range<int>{field<&Options::expert, &ExpertOptions::tree, &TreeShape::round_robin_block>, 0,
                std::numeric_limits<int>::max()}},
    {"axes.plain", "", "Whether points on a plane stay together",
     choice_of<&Options::expert, &ExpertOptions::axes, &Axes::plain>(switch_words)},
    {"axes.order", "RRCB_AXES", "Axis that each box is cut across",
     Choice{axis_rule_words, std::size(axis_rule_words), axis_rule_of, set_axis_rule}},
    {"one of axes.order, axes.min_width, axes.grid", "", "Axes and places of the cuts",
     Lists{values_of_tree, check_tree_options}},
    {"axes.steps", "RRCB_STEPS", "Steps of the program from one partition to the next",
     Range<double>{field<&Options::expert, &ExpertOptions::axes, &Axes::steps>, 0,
                   std::numeric_limits<double>::max(), true}},
    {"axes.min_width", "RRCB_MIN_WIDTH", "Least extent of every part along each axis",
     Rows{min_width_of, check_min_width, set_min_width, 1, "a number above 0 for each axis",
          "0.1 0.1"}},
    {"axes.grid", "RRCB_GRID", "Lines of a grid across each axis that all cuts lie on",
     Rows{grid_of, check_grid, set_grid, 2, "an origin and a spacing above 0 for each axis",
          "0 0.05, 0 0.05"}},
    {"refine", "RRCB_REFINE",
     "Accuracy to which the estimated cuts are corrected by counting objects",
     choice_of<&Options::refine>(refine_words)},
    {"coincident", "RRCB_COINCIDENT", "Coincident points that a balanced cut would divide",
     choice_of<&Options::expert, &ExpertOptions::coincident>(coincident_words)},
    {"imbalance_tolerance", "IMBALANCE_TOL",
     "Heaviest part / mean part to reach with RRCB_REFINE=TOLERANCE",
     Range<double>{field<&Options::imbalance_tolerance>, 1, std::numeric_limits<double>::max()}},
    {"max_root_parts", "RRCB_CENTRAL_PARTS",
     "Most parts that rank 0 makes; if there are more, and more ranks, many ranks make them",
     Range<int>{field<&Options::expert, &ExpertOptions::max_root_parts>, 2,
                std::numeric_limits<int>::max()}},
};

/// Returns true if ranks compare the value of this option on its own.
constexpr bool is_compared(const Option& option) {
    return !std::holds_alternative<Rows>(option.kind);
}

/// Return the option with this name in Options, or with this parameter name. Return null if there
/// is none or the name is empty.
const Option* find_option(std::string_view name);
const Option* find_parameter(std::string_view parameter);

/// Returns the names of all options that can be written as text.
std::vector<std::string> option_names();

/// Returns the names most similar to an unknown one, as the end of an error: "; did you mean
/// refine?". Returns an empty text if no name is similar.
std::string suggestion(std::string_view given, const std::vector<std::string>& names);

/// Calls visit(kind) with the kind of the option's values.
template <class Visit>
decltype(auto) visit_kind(const Option& option, Visit&& visit) {
    return std::visit(visit, option.kind);
}

/// Returns true if the option's value in `options` is legal in this dimension. Always true for
/// lists.
bool is_legal(const Option& option, const Options& options, int dimension);

/// Returns the condition that a number must meet, for the text of an error: "at least 1".
std::string requirement(const Option& option, int dimension);

/// Returns the legal values in words: "a number above 0, at most 1", "WEIGHTED or MIDPOINT".
std::string legal_values(const Option& option);

/// Returns the texts that read_option() accepts: "a whole number, 1 or more, or 0 or AUTO for one
/// part per rank".
std::string texts_of(const Option& option);

/// Returns a sentence on the effect and the values of the option.
std::string documentation(const Option& option);

/// Reads a value: a number, a word in upper or lower case, or AUTO for a 0 that has a meaning. The
/// value must be legal in some dimension; otherwise returns false and sets nothing.
bool read_option(const Option& option, std::string_view text, Options& options);

/// Returns the value as a text that read_option() accepts.
std::string write_option(const Option& option, const Options& options);

}  // namespace rrcb
