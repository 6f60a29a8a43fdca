#include "effects/effect.hpp"

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    builder.stages.volume_change = VolumeChange::shared;
}

}  // namespace

/// Prevents locking of materials that keep their volume. All points that share their nodes change
/// their volume at the rate of their centre (selective reduced integration, like the B-bar method
/// of Hughes 1980).
EffectKind locking_cure_effect() {
    return {"locking_cure", {}, build<2>, build<3>};
}

}  // namespace mpm
