#include "refinement/refinement_buffers.hpp"

namespace rrcb {

RefinementBuffers::RefinementBuffers(const Options& options, int dimension, bool is_root)
    : part_weights(options.part_sizes.size() + 1),
      sums(options.part_sizes.size() + 2),
      histograms(HistogramLayout{}, options.part_sizes.size() / 2, is_root),
      candidates(dimension) {
    const std::size_t num_parts = options.part_sizes.size();
    nodes.reserve(num_parts);
    children.reserve(num_parts);
    // A node that is searched has two parts or more.
    searched.reserve(num_parts / 2);
    searches.reserve(num_parts / 2);
    before.reserve(num_parts / 2);
    targets.reserve(num_parts / 2);
    local.reserve(num_parts / 2);
    samples.reserve(num_parts / 2);
    lots.reserve(num_parts / 2);
}

}  // namespace rrcb
