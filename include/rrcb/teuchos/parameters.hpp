#pragma once

#include <rrcb/export.h>
#include <rrcb/options.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_RCP.hpp>

#include <string>
#include <utility>
#include <vector>

namespace rrcb::teuchos {

/// Returns all parameters under their names in the Zoltan plug-in, with defaults, documentation and
/// validators. You can print it with `print(out, PrintOptions().showDoc(true))`. Not collective.
RRCB_API Teuchos::RCP<const Teuchos::ParameterList> valid_parameters();

/// Reads a list from a file that Teuchos has written, whose name ends in .xml, .yaml or .yml.
///
/// Not collective. Throws Error with the name of the file if it cannot be read. The list is checked
/// when it is used.
RRCB_API Teuchos::ParameterList read_parameters(const std::string& file);

/// Returns the options that a list sets; all others have their default.
///
/// RRCB_DUMP and RRCB_DUMP_WHEN are for the plug-in; they are only checked. A whole number may
/// stand for a real one. Not collective; balance() checks that ranks agree. Throws Error for an
/// unknown name, a wrong type or a value out of range.
RRCB_API Options options_from(const Teuchos::ParameterList& list);

/// Returns the names and values of the settings in a list, for Zoltan_Set_Param; see
/// zoltan_parameters.hpp.
///
/// Not collective. Throws Error as options_from().
RRCB_API std::vector<std::pair<std::string, std::string>> zoltan_strings(
    const Teuchos::ParameterList& list);

}  // namespace rrcb::teuchos
