#pragma once

#include <Teuchos_ParameterList.hpp>
#include <mpm/parameters.hpp>
#include <mpm/vector.hpp>

#include <string>
#include <vector>

namespace mpm {

/// A list of a scene file with its place, for errors.
class List {
  public:
    List(Teuchos::ParameterList list, std::string place)
        : list_(std::move(list)), place_(std::move(place)) {}

    const std::string& place() const { return place_; }

    /// Names of the lists in this one, in the order of the file. Throws where it holds anything
    /// else.
    std::vector<std::string> sublist_names() const;
    bool has(const std::string& name) const { return list_.isParameter(name); }
    /// Throws for a list that nobody has taken. The text names the possible ones.
    void refuse_other_lists(const std::string& possible) const;
    /// Takes out the list of this name, empty where there is none. Throws where it is no list.
    List take_list(const std::string& name);
    /// Takes out rows of as many numbers as there are dimensions.
    std::vector<Vector> take_rows(const std::string& name, int dimension);
    /// Entries not taken, which must be numbers, words and rows of numbers.
    Parameters parameters() const;
    /// Entries not taken, checked by the rules.
    Values values(const std::vector<Rule>& rules, int dimension) const {
        return {parameters(), rules, place_, dimension};
    }

    [[noreturn]] void refuse(const std::string& name, const std::string& text) const;

  private:
    Teuchos::ParameterList list_;
    std::string place_;
};

/// Numbers along the axes as a vector.
Vector vector_of(const std::vector<double>& numbers);

}  // namespace mpm
