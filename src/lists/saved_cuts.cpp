#include "collective/saved_state.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/restart.hpp>

#include <array>

namespace rrcb {

namespace {

/// Writes or reads cuts.
void store(SavedState& state, Cuts& cuts) {
    std::array<double, 2> unused{};  // version 0.2 kept numbers here
    state.each(cuts.dimension, cuts.num_parts, cuts.shape.group_size, cuts.shape.larger_below,
               cuts.shape.round_robin_block, unused[0], unused[1]);
    std::size_t num_cuts = cuts.tree.size();
    state.count(num_cuts, state.num_left() / 3);
    cuts.tree.resize(num_cuts);
    for (Cut& cut : cuts.tree) state.each(cut.axis, cut.divides, cut.at);
    if (state.num_left() == 0) return;  // saved by version 0.2
    std::size_t num_numbers = cuts.numbers.size();
    state.count(num_numbers, state.num_left());
    cuts.numbers.resize(num_numbers);
    state.each(cuts.numbers, cuts.debt);
}

}  // namespace

std::vector<std::byte> save(const Cuts& cuts) {
    check_tree(cuts);
    return locally([&] {
        SavedState state(StateKind::cuts);
        Cuts copy = cuts;
        store(state, copy);
        return state.bytes();
    });
}

Cuts detail::load_cuts(std::span<const std::byte> bytes) {
    return locally([&] {
        SavedState state(bytes, StateKind::cuts);
        Cuts cuts;
        store(state, cuts);
        check_tree(cuts);
        return cuts;
    });
}

}  // namespace rrcb
