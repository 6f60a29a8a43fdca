#pragma once

#include <rrcb/options.hpp>
#include <rrcb/paper.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace comparisons {

/// Options of one of the library's methods: its own, or the paper's.
using OwnOptions = std::variant<rrcb::Options, rrcb::PaperOptions>;

/// A partitioner and its settings.
struct Method {
    std::string label;                  ///< as the user wrote it, brackets and all
    std::string lb_method;              ///< Zoltan's LB_METHOD
    std::optional<OwnOptions> options;  ///< of the library's methods; none for Zoltan's
    bool seed_given = false;            ///< the user chose the seed of its points
    bool reuses = false;                ///< starts from the cuts of its last call
    bool locks_axes = false;            ///< keeps the axes of the cuts of its first call

    /// The seed of its pseudo-random points.
    std::uint64_t seed() const { return std::get<rrcb::PaperOptions>(*options).seed; }
};

/// Balances points by one of the library's methods. Collective over `comm`.
rrcb::Balance balance(const OwnOptions& options, const rrcb::Points& points, MPI_Comm comm);

/// `lb_method` of Zoltan2's multijagged, which is none of Zoltan's, and the imbalance asked of it:
/// that of rrcb.
inline constexpr const char* multijagged = "multijagged";
inline constexpr double multijagged_tolerance = 1.01;

/// `lb_method` of rrcb::balance on the driver's own arrays: no callbacks, no lists of Zoltan's.
inline constexpr const char* on_arrays = "rrcb::balance";

/// `lb_method` of a Hilbert curve cut by counted keys, on the driver's own arrays.
inline constexpr const char* hilbert_counts = "counted keys";

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

/// Default methods: Zoltan's RCB, the paper's method, and rrcb to a tolerance and exactly.
std::vector<Method> default_methods();

/// Every method, of the paper's the four settings it names best, of rrcb several tolerances.
std::vector<Method> all_methods();

/// Whether its points are pseudo-random and their seed is left open, so that it is to be judged
/// over several.
bool varies_with_seed(const Method& method);

/// The method with a seed that many further; unchanged where it does not vary.
Method with_next_seed(Method method, std::uint64_t offset);

/// Value of RETURN_LISTS.
const char* lists_name(Lists lists);

/// Parameters of Zoltan: name and value.
using ZoltanParameters = std::vector<std::pair<std::string, std::string>>;

/// What makes Zoltan_LB_Partition this method, or tells what it is where that is not called.
/// Zoltan's own defaults but for DEBUG_LEVEL 0.
ZoltanParameters zoltan_parameters(const Method& method, Lists lists);

}  // namespace comparisons
