#pragma once

#include <rrcb/options.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons {

/// A partitioner by name, with what makes it so.
struct Method {
    std::string label;                     ///< as the user wrote it, brackets and all
    std::string lb_method;                 ///< Zoltan's LB_METHOD
    std::optional<rrcb::Options> options;  ///< of our own methods; none for Zoltan's
};

/// `lb_method` of Zoltan2's multijagged, which is none of Zoltan's, and the imbalance asked of it:
/// that of rrcb.
inline constexpr const char* multijagged = "multijagged";
inline constexpr double multijagged_tolerance = 1.01;

/// Which lists are asked of Zoltan_LB_Partition (RETURN_LISTS).
enum class Lists { parts, exports, all };

/// Reads "rrcb" or "rrcb-sampled[mesh=4,k=2,fraction=0.25]".
///
/// Throws Failure that names the mistake and what is possible, for an unknown method, a key it
/// does not take, or a value out of range.
Method read_method(std::string_view text);

/// Reads a list of different methods, separated by commas; throws Failure like read_method.
std::vector<Method> read_methods(std::string_view text);

/// Names of all methods, as in "a, b, c".
std::string method_names();

/// Value of RETURN_LISTS.
const char* lists_name(Lists lists);

/// Parameters of Zoltan: name and value.
using ZoltanParameters = std::vector<std::pair<std::string, std::string>>;

/// What makes Zoltan_LB_Partition this method. Zoltan's own defaults but for DEBUG_LEVEL 0.
ZoltanParameters zoltan_parameters(const Method& method, Lists lists);

}  // namespace comparisons
