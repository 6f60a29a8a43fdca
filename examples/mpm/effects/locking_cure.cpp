#include "effects/effect.hpp"

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    builder.stages.volume_change = VolumeChange::shared;
}

}  // namespace

/// A cure of locking where volume is kept: the points that share their nodes change their volume as
/// their centre (selective reduced integration, as the B-bar method of Hughes 1980).
EffectKind locking_cure_effect() {
    return {"locking_cure", {}, build<2>, build<3>};
}

}  // namespace mpm
