#include "bisection/learned_prior.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>

namespace rrcb {

namespace {

/// Numbers that the learned weights were made for.
struct LearnedLayout {
    int inputs_per_cell;
    int sub_cells_per_axis;
    int neurons_1;
    int neurons_2;

    bool operator==(const LearnedLayout&) const = default;
};

constexpr LearnedLayout learned_layout{6, num_sub, 64, 64};
constexpr int num_inputs = 9 * learned_layout.inputs_per_cell + 1;

#include "bisection/learned_weights.inc"

/// A layer of neurons: whole numbers by neuron, and a scale and an offset for each.
template <int num_in, int num_out>
class Layer {
  public:
    template <std::size_t num_weights, std::size_t num_scales, std::size_t num_offsets>
    Layer(const std::int8_t (&weights)[num_weights], const float (&scales)[num_scales],
          const float (&offsets)[num_offsets])
        : weights_(weights), scales_(scales), offsets_(offsets) {
        static_assert(num_weights == std::size_t{num_in} * num_out && num_scales == num_out &&
                          num_offsets == num_out,
                      "learned weights of another layout: run tools/train_domain");
    }

    Eigen::Matrix<double, num_out, 1> operator()(const Eigen::Matrix<double, num_in, 1>& in) const {
        Eigen::Matrix<double, num_out, 1> out = weights_.template cast<double>() * in;
        return out.cwiseProduct(scales_.template cast<double>()) + offsets_.template cast<double>();
    }

  private:
    using Weights = Eigen::Matrix<std::int8_t, num_out, num_in, Eigen::RowMajor>;
    using PerNeuron = Eigen::Matrix<float, num_out, 1>;

    Eigen::Map<const Weights> weights_;
    Eigen::Map<const PerNeuron> scales_;
    Eigen::Map<const PerNeuron> offsets_;
};

using Inputs = Eigen::Matrix<double, num_inputs, 1>;

Inputs inputs_of(const Neighbourhood& around) {
    const double even = std::sqrt(1.0 / 12);
    Inputs inputs;
    int k = 0;
    for (const auto& row : around.cells) {
        for (const CellInputs& cell : row) {
            inputs[k++] = cell.ratio;
            for (const double mean : cell.mean) inputs[k++] = 4 * mean;
            for (const double deviation : cell.deviation)
                inputs[k++] = cell.ratio > 0 ? 8 * (deviation - even) : -2;
            inputs[k++] = cell.is_outside ? 1 : 0;
        }
    }
    inputs[k] = std::log2(std::max(1.0, around.count)) / 8;
    return inputs;
}

}  // namespace

SubCells learned_prior(const Neighbourhood& around) {
    constexpr int neurons_1 = learned_layout.neurons_1;
    constexpr int neurons_2 = learned_layout.neurons_2;
    const Layer<num_inputs, neurons_1> layer_1(weights_1, scales_1, offsets_1);
    const Layer<neurons_1, neurons_2> layer_2(weights_2, scales_2, offsets_2);
    const Layer<neurons_2, num_sub * num_sub> layer_3(weights_3, scales_3, offsets_3);
    const auto hidden = [](const auto& sums) { return sums.cwiseMax(0).eval(); };
    return layer_3(hidden(layer_2(hidden(layer_1(inputs_of(around))))));
}

}  // namespace rrcb
