#pragma once

#include "paper/paper_text.hpp"
#include "paper/paper_words.hpp"

#include <rrcb/options.hpp>
#include <rrcb/paper.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb::zoltan {

/// Lists that a partitioning call returns (RETURN_LISTS). As in Zoltan, the largest value of all
/// ranks applies.
enum class ReturnLists { none, imports, exports, parts, all, candidates };

/// Value of NUM_GLOBAL_PARTS if it is set to its default or to a text that is not a legal number.
inline constexpr int one_per_rank = 0;

/// Value of an unset parameter whose default depends on others.
inline constexpr int not_set = std::numeric_limits<int>::min();

/// Returns the options of a new handle, with which coincident points are divided, as by Zoltan's
/// RCB.
Options default_options();

/// Names and values of parameters, in the order in which they were last set. Setting them again in
/// this order has the same effect.
struct GivenParameters {
    /// Notes a parameter. Returns whether its value has changed.
    bool note(const std::string& name, const std::string& value);

    /// Returns the value of a parameter; null if it was not set.
    const std::string* find(std::string_view name) const;

    std::vector<std::pair<std::string, std::string>> entries{};
};

/// Parameters of a handle that the plug-in needs. The defaults are Zoltan's.
struct Parameters {
    bool rrcb = false;         ///< whether LB_METHOD is RRCB, or is RCB and RRCB replaces that
    bool replace_rcb = false;  ///< whether RRCB answers for LB_METHOD=RCB
    int num_gid_entries = 1;
    int num_lid_entries = 1;
    int weight_dimension = 0;
    int num_global_parts = -1;  ///< -1: not set; one_per_rank: number of ranks
    int num_local_parts = -1;   ///< -1: not set
    int keep_cuts = 0;
    int auto_migrate = 0;
    int remap = 1;
    int reuse_cuts = not_set;
    int lock_directions = 0;
    int set_directions = 0;
    int rectilinear_blocks = 0;
    int average_cuts = 0;
    int reduce_dimensions = 0;
    int output_level = 0;
    int final_output = 0;
    int debug_level = 1;
    ReturnLists return_lists = ReturnLists::all;
    Options options = default_options();  ///< only the parameters RRCB_*; the parts are filled in
                                          ///< for each call

    std::optional<PaperDomain> paper_domain;  ///< RRCB_DOMAIN; empty for RRCB's own method
    CutRule cut_rule = PaperOptions{}.cut_rule;
    double sigma_multiplier = PaperOptions{}.sigma_multiplier;
    double sample_fraction = PaperOptions{}.sample_fraction;
    std::uint64_t seed = PaperOptions{}.seed;

    std::string dump_folder;   ///< folder for dumps of the inputs of calls; empty for no dumps
    bool dump_always = false;  ///< whether all calls are dumped, not only failing ones
    GivenParameters given;     ///< all settings in the form in which they were given
};

/// Returns whether RCB_REUSE is in effect. By default it is if RRCB replaces RCB, so that a
/// balanced distribution is kept.
bool reuses_cuts(const Parameters& parameters);

// These functions read a value, which is in upper case except for RRCB_DUMP. For an illegal value
// they return false and set nothing.
bool read_integer(int& value, std::string_view text, int least);
bool read_return_lists(ReturnLists& lists, std::string_view text);
bool read_folder(std::string& folder, std::string_view text);
bool read_dump_when(bool& always, std::string_view text);

/// Reads an integer. Below `least` it is illegal, and Zoltan uses the default.
template <int least = std::numeric_limits<int>::min()>
bool read_integer(int& value, std::string_view text) {
    return read_integer(value, text, least);
}

/// Returns a number by which ranks compare values; equal values have equal numbers.
template <class Value>
constexpr int number_of(const Value& value) {
    if constexpr (std::is_same_v<Value, std::optional<PaperDomain>>) {
        return value ? 1 + static_cast<int>(*value) : 0;
    } else if constexpr (sizeof(Value) == sizeof(std::uint64_t)) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        return static_cast<int>(static_cast<std::uint32_t>(bits ^ (bits >> 32)));
    } else {
        return static_cast<int>(value);
    }
}

/// Returns the value that DEFAULT and illegal texts stand for: that of a new handle, with two
/// exceptions.
template <class Value>
Value fallback_of(Value Parameters::*field) {
    return Parameters{}.*field;
}
int fallback_of(int Parameters::*field);

/// A parameter that has its own member in Parameters.
struct ParameterRow {
    const char* name;
    bool (*read)(Parameters&, std::string_view text);
    void (*reset)(Parameters&);
    /// Returns a number that must be the same on all ranks, because otherwise their messages would
    /// not match.
    std::optional<int (*)(const Parameters&)> compared;
};

template <auto field>
int number_in(const Parameters& parameters) {
    return number_of(parameters.*field);
}

template <auto member>
int is_on(const Parameters& parameters) {
    return std::invoke(member, parameters) ? 1 : 0;
}

/// Row of a parameter whose value may differ between ranks.
template <auto field, auto read>
constexpr ParameterRow may_differ(const char* name) {
    return {name, [](Parameters& p, std::string_view text) { return read(p.*field, text); },
            [](Parameters& p) { p.*field = fallback_of(field); }, std::nullopt};
}

/// Row of a parameter whose value must be the same on all ranks.
template <auto field, auto read, int (*compared)(const Parameters&) = number_in<field>>
constexpr ParameterRow must_agree(const char* name) {
    ParameterRow row = may_differ<field, read>(name);
    row.compared = compared;
    return row;
}

/// Row of a parameter that is on for any number except 0. It must be on either on all ranks or on
/// none.
template <auto field>
constexpr ParameterRow flag(const char* name) {
    return must_agree<field, read_integer<>, is_on<field>>(name);
}

/// All parameters except LB_METHOD and those in Options. Compared ones are in the order in which
/// differences are reported.
inline constexpr ParameterRow parameter_table[] = {
    must_agree<&Parameters::num_gid_entries, read_integer<1>>("NUM_GID_ENTRIES"),
    must_agree<&Parameters::num_lid_entries, read_integer<0>>("NUM_LID_ENTRIES"),
    must_agree<&Parameters::weight_dimension, read_integer<0>>("OBJ_WEIGHT_DIM"),
    flag<&Parameters::auto_migrate>("AUTO_MIGRATE"),
    flag<&Parameters::remap>("REMAP"),
    must_agree<&Parameters::reuse_cuts, read_integer<>, is_on<reuses_cuts>>("RCB_REUSE"),
    flag<&Parameters::average_cuts>("AVERAGE_CUTS"),
    may_differ<&Parameters::return_lists, read_return_lists>("RETURN_LISTS"),
    flag<&Parameters::lock_directions>("RCB_LOCK_DIRECTIONS"),
    must_agree<&Parameters::set_directions, read_integer<>>("RCB_SET_DIRECTIONS"),
    flag<&Parameters::rectilinear_blocks>("RCB_RECTILINEAR_BLOCKS"),
    flag<&Parameters::reduce_dimensions>("REDUCE_DIMENSIONS"),
    must_agree<&Parameters::paper_domain, read_domain>(domain_parameter.parameter),
    must_agree<&Parameters::cut_rule, read_cut_rule>(cut_rule_parameter.parameter),
    must_agree<&Parameters::sigma_multiplier, read_sigma_multiplier>(sigma_parameter.parameter),
    must_agree<&Parameters::sample_fraction, read_sample_fraction>(fraction_parameter.parameter),
    must_agree<&Parameters::seed, read_seed>(seed_parameter.parameter),
    may_differ<&Parameters::num_global_parts, read_integer<1>>("NUM_GLOBAL_PARTS"),
    may_differ<&Parameters::num_global_parts, read_integer<1>>("NUM_GLOBAL_PARTITIONS"),
    may_differ<&Parameters::num_local_parts, read_integer<0>>("NUM_LOCAL_PARTS"),
    may_differ<&Parameters::num_local_parts, read_integer<0>>("NUM_LOCAL_PARTITIONS"),
    may_differ<&Parameters::keep_cuts, read_integer<>>("KEEP_CUTS"),
    may_differ<&Parameters::output_level, read_integer<>>("RCB_OUTPUT_LEVEL"),
    may_differ<&Parameters::final_output, read_integer<>>("FINAL_OUTPUT"),
    may_differ<&Parameters::debug_level, read_integer<0>>("DEBUG_LEVEL"),
    may_differ<&Parameters::dump_folder, read_folder>(dump_parameter.parameter),
    may_differ<&Parameters::dump_always, read_dump_when>(dump_when_parameter.parameter),
};

enum class Setting {
    accepted,  ///< the value was stored
    refused,   ///< the value is illegal; the previous one is kept
    unknown    ///< RRCB has no parameter of this name
};

/// Sets one of RRCB's own parameters (RRCB_...). The name must be in upper case; the value is as
/// the program gives it.
Setting set_own(Parameters& parameters, std::string_view name, const char* value);

/// Sets IMBALANCE_TOL. If the value is not a number of at least 1, returns false and sets nothing.
bool set_tolerance(Parameters& parameters, std::string_view value);

/// Returns all names that set_own() accepts.
std::vector<const char*> own_parameter_names();

/// Notes a parameter that Zoltan itself has accepted, if RRCB needs it. Name and value are in upper
/// case.
void note_common(Parameters& parameters, std::string_view name, std::string_view value);

/// Returns a name or value in the form in which Zoltan compares it: upper case, no leading blanks.
std::string clean(const char* text);

/// Returns a text without trailing blanks, which are never part of a value.
std::string_view without_trailing_blanks(std::string_view text);

}  // namespace rrcb::zoltan
