#pragma once

#include <mpm/parameters.hpp>
#include <mpm/vector.hpp>

#include <string>
#include <vector>

namespace mpm {

/// A list of a scene file.
struct List {
    std::string name;
    std::string place;  ///< its name after those of the lists around it, for messages of errors
    Parameters parameters;
    std::vector<List> lists;  ///< the lists inside it, in the order of the file

    /// Returns the list of this name, or an empty one if there is none.
    List list(const std::string& wanted) const;
    /// Returns the lists in a list of lists. Throws if it contains anything else.
    std::vector<List> lists_in(const std::string& wanted) const;
    /// Throws if it contains a list whose name is not one of these.
    void check_lists(const std::vector<std::string>& possible) const;
    /// Returns the parameters, checked by the rules. Throws if it contains a list that is not
    /// possible.
    Values values(const std::vector<Rule>& rules, int dimension,
                  const std::vector<std::string>& possible = {}) const;

    [[noreturn]] void refuse(const std::string& key, const std::string& text) const;
};

/// Parses a text of YAML, which must contain one list named scene. Throws std::invalid_argument.
List parse_list(const std::string& text);

/// Returns numbers along the axes as a vector.
Vector vector_of(const std::vector<double>& numbers);

}  // namespace mpm
