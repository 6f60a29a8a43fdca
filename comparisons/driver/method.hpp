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

/// The options of one of the library's own methods, or of a method of the paper.
using OwnOptions = std::variant<rrcb::Options, rrcb::PaperOptions>;

/// A partitioner with its settings.
struct Method {
    std::string label;                  ///< as the user wrote it, with the brackets
    std::string lb_method;              ///< Zoltan's LB_METHOD
    std::optional<OwnOptions> options;  ///< of a method of the library; nullopt for one of Zoltan's
    bool seed_given = false;  ///< whether the user chose the seed of the pseudo-random points
    bool reuses = false;      ///< whether it starts from the cuts of its previous call
    bool locks_axes = false;  ///< whether it keeps the axes of the cuts of its first call

    /// Returns the seed of the pseudo-random points.
    std::uint64_t seed() const { return std::get<rrcb::PaperOptions>(*options).seed; }
};

/// Divides points by one of the library's methods. Collective over `comm`.
rrcb::Balance balance(const OwnOptions& options, const rrcb::Points& points, MPI_Comm comm);

/// The `lb_method` of Zoltan2's multijagged, which Zoltan does not have. The tolerance passed to it
/// is that of rrcb.
inline constexpr const char* multijagged = "multijagged";
inline constexpr double multijagged_tolerance = 1.01;

/// The `lb_method` of rrcb::balance called with arrays, without Zoltan's callbacks and lists.
inline constexpr const char* on_arrays = "rrcb::balance";

/// The `lb_method` of a Hilbert curve that is cut by counting keys, called with arrays.
inline constexpr const char* hilbert_counts = "counted keys";

/// The lists that Zoltan_LB_Partition returns (RETURN_LISTS).
enum class Lists { parts, exports, all };

/// Parses a method like "rrcb" or "rrcb-sampled[mesh=4,k=2,fraction=0.25]".
///
/// Throws Failure for an unknown method, a key that the method does not have, or a value out of
/// range. The message contains the mistake and the allowed values.
Method read_method(std::string_view text);

/// Parses a list of different methods, separated by commas. Throws Failure like read_method.
std::vector<Method> read_methods(std::string_view text);

/// Returns the names of all methods, separated by commas.
std::string method_names();

/// Returns the default methods: Zoltan's RCB, the paper's method, and rrcb to a tolerance and
/// exactly.
std::vector<Method> default_methods();

/// Returns every method. The paper's method has the four settings that the paper names as best,
/// rrcb has several tolerances.
std::vector<Method> all_methods();

/// Returns whether the method uses pseudo-random points and the user has not chosen their seed.
/// Such a method is judged with several seeds.
bool varies_with_seed(const Method& method);

/// Returns the method with its seed increased by `offset`, if it varies with the seed.
Method with_next_seed(Method method, std::uint64_t offset);

/// Returns the value of RETURN_LISTS.
const char* lists_name(Lists lists);

/// Parameters of Zoltan, as pairs of name and value.
using ZoltanParameters = std::vector<std::pair<std::string, std::string>>;

/// Returns the parameters with which Zoltan_LB_Partition runs this method. For a method that is not
/// run by Zoltan they only describe it. All other parameters have Zoltan's defaults, except
/// DEBUG_LEVEL, which is 0.
ZoltanParameters zoltan_parameters(const Method& method, Lists lists);

}  // namespace comparisons
