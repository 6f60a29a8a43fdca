#include "transfer/transfers_of.hpp"

namespace mpm {

template std::unique_ptr<Transfers<3>> make_with<3, QuadraticShape>(const Scene&, const FlipShare&,
                                                                    Particles&);

}  // namespace mpm
