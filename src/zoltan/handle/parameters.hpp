#pragma once

#include <rrcb/options.hpp>

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rrcb::zoltan {

/// Which lists a partitioning call returns (RETURN_LISTS).
enum class ReturnLists { none, imports, exports, all, parts, candidates };

/// NUM_GLOBAL_PARTS where it is set to its default or to no legal number.
inline constexpr int one_per_rank = 0;

/// Value of a parameter that is not set and whose default depends on others.
inline constexpr int not_set = std::numeric_limits<int>::min();

/// The options of a new handle: points in one place are divided, as by RCB.
Options default_options();

/// Parameters of a handle that concern the plug-in. The defaults are Zoltan's.
struct Parameters {
    bool rrcb = false;         ///< LB_METHOD is RRCB, or RCB where that is replaced
    bool replace_rcb = false;  ///< RRCB answers LB_METHOD=RCB
    int num_gid_entries = 1;
    int num_lid_entries = 1;
    int weight_dimension = 0;
    int num_global_parts = -1;  ///< -1: not set, one_per_rank: as many as ranks
    int num_local_parts = -1;   ///< -1: not set
    int keep_cuts = 0;
    int auto_migrate = 0;
    int remap = 1;
    int reuse_cuts = not_set;
    int lock_directions = 0;
    int set_directions = 0;
    int rectilinear_blocks = 0;
    int average_cuts = 0;
    int weights_comparable = 0;
    int multicriteria_norm = 1;
    int reduce_dimensions = 0;
    double degenerate_ratio = 10;
    double max_aspect_ratio = 10;
    int output_level = 0;
    int final_output = 0;
    int debug_level = 1;
    ReturnLists return_lists = ReturnLists::all;
    Options options = default_options();  ///< RRCB_* only; parts are filled in per call

    double skip_within =
        0;  ///< imbalance up to which objects stay without a look at new cuts; 0: none
    std::string dump_folder;   ///< where the inputs of calls go; empty: nowhere
    bool dump_always = false;  ///< the inputs of all calls, not only of failing ones
    std::map<std::string, std::string> given;  ///< all that was set, as it was set
};

enum class Setting {
    accepted,   ///< stored
    defaulted,  ///< illegal value; the default was stored
    unknown     ///< not one of RRCB's own parameters
};

/// Sets a parameter of RRCB's own (RRCB_...). The name is in upper case, the value as it was given.
Setting set_own(Parameters& parameters, std::string_view name, const char* value);

/// Sets IMBALANCE_TOL. Returns false for a value that is no number of at least 1, and leaves it.
bool set_tolerance(Parameters& parameters, std::string_view value);

/// The names that set_own knows.
std::vector<const char*> own_parameter_names();

/// Notes a parameter that Zoltan itself has accepted, if it matters here. Both are in upper case.
void note_common(Parameters& parameters, std::string_view name, std::string_view value);

/// Name or value in the form in which Zoltan compares it: in upper case, without leading blanks.
std::string clean(const char* text);

/// Text without trailing blanks, which belong to no value.
std::string_view without_trailing_blanks(std::string_view text);

}  // namespace rrcb::zoltan
