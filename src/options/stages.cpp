#include <rrcb/stages.hpp>

namespace rrcb {

const char* name_of(Stage stage) {
    switch (stage) {
        case Stage::moments:
            return "moments";
        case Stage::gather:
            return "gather";
        case Stage::bisection:
            return "bisection";
        case Stage::broadcast:
            return "broadcast";
        case Stage::refinement:
            return "refinement";
        case Stage::assignment:
            return "assignment";
    }
    return "";
}

}  // namespace rrcb
