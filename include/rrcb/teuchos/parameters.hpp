#pragma once

#include <rrcb/options.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_RCP.hpp>

#include <string>
#include <utility>
#include <vector>

namespace rrcb::teuchos {

/// Returns all parameters under their names in the Zoltan plug-in, with defaults, documentation and
/// validators; print it with `print(out, PrintOptions().showDoc(true))`. Not collective.
RRCB_API Teuchos::RCP<const Teuchos::ParameterList> valid_parameters();

/// Reads a list from a file whose name ends in .xml, .yaml or .yml, as Teuchos writes them.
///
/// Not collective. Throws Error with the file's name if it cannot be read; the list is checked when
/// it is used.
RRCB_API Teuchos::ParameterList read_parameters(const std::string& file);

/// Returns the options of a list; others keep their default.
///
/// RRCB_DUMP and RRCB_DUMP_WHEN are for the plug-in only, and are only checked. A whole number may
/// stand for a real one. Not collective; `balance` checks that ranks agree. Throws Error for an
/// unknown name, a wrong type or a value out of range.
RRCB_API Options options_from(const Teuchos::ParameterList& list);

/// Returns names and values of the settings of a list, for Zoltan_Set_Param; see
/// zoltan_parameters.hpp.
///
/// Not collective. Throws Error as options_from().
RRCB_API std::vector<std::pair<std::string, std::string>> zoltan_strings(
    const Teuchos::ParameterList& list);

}  // namespace rrcb::teuchos
