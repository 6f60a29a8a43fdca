#include "transfer/transfers_of.hpp"

namespace mpm {

template std::unique_ptr<Transfers<2>> make_transfers<2>(const Scene&, const FlipShare&,
                                                         Particles&);

}  // namespace mpm
