#include "transfer/transfers_of.hpp"

namespace mpm {

// Half of the time that all transfers take to compile.
extern template std::unique_ptr<Transfers<3>> make_with<3, QuadraticShape>(const Scene&,
                                                                           const FlipShare&,
                                                                           Particles&);

template std::unique_ptr<Transfers<3>> make_transfers<3>(const Scene&, const FlipShare&,
                                                         Particles&);

}  // namespace mpm
