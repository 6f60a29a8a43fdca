#include <rrcb/stages.hpp>

namespace rrcb {

const char* name_of(Stage stage) {
    static constexpr std::array names = {"moments",   "gather",     "bisection",
                                         "broadcast", "refinement", "assignment"};
    static_assert(names.size() == stages.size());
    const auto number = static_cast<std::size_t>(stage);
    return number < names.size() ? names[number] : "";
}

}  // namespace rrcb
