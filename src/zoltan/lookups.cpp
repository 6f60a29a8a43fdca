#include "lookups.hpp"

#include "failure.hpp"

#include <algorithm>
#include <cfloat>
#include <string>

namespace rrcb::zoltan {

namespace {

const Kept& kept_by(const State& state) {
    if (!state.kept) {
        throw Failure(ZOLTAN_FATAL, "No Decomposition Data available; use KEEP_CUTS parameter.");
    }
    return *state.kept;
}

}  // namespace

Place place_of(const State& state, const double* coordinates) {
    const Kept& kept = kept_by(state);
    Vector position{};
    std::copy_n(coordinates, kept.cuts.dimension, position.begin());
    const Part part = part_of(kept.cuts, position);
    return {kept.map.ranks[static_cast<std::size_t>(part)].first, part};
}

Touched touched_by(const State& state, const Box& box) {
    const Kept& kept = kept_by(state);
    Touched touched;
    touched.parts = parts_touching(kept.cuts, box);
    for (const Part part : touched.parts) {
        const RankRange& range = kept.map.ranks[static_cast<std::size_t>(part)];
        // Parts ascend, and so do their ranks: only the last one can come twice.
        const int next = touched.ranks.empty() ? 0 : touched.ranks.back() + 1;
        for (int r = std::max(range.first, next); r < range.first + range.count; ++r) {
            touched.ranks.push_back(r);
        }
    }
    return touched;
}

Box region_of(const State& state, int part) {
    const Kept& kept = kept_by(state);
    if (part < 0 || part >= kept.cuts.num_parts) {
        throw Failure(ZOLTAN_FATAL, "Invalid part number " + std::to_string(part));
    }
    Box box = box_of(kept.cuts, part);
    for (std::size_t a = 0; a < max_dimension; ++a) {
        const bool used = static_cast<int>(a) < kept.cuts.dimension;
        box.lower[a] = used ? std::max(box.lower[a], -DBL_MAX) : -DBL_MAX;
        box.upper[a] = used ? std::min(box.upper[a], DBL_MAX) : DBL_MAX;
    }
    return box;
}

void require_one_part_per_rank(const State& state, const char* alternative) {
    if (kept_by(state).map.one_each) return;
    throw Failure(ZOLTAN_FATAL,
                  std::string("Non-uniform distribution of parts over processors is specified; "
                              "use ") +
                      alternative);
}

}  // namespace rrcb::zoltan
