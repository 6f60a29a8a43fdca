#include "particles/stress.hpp"

#include <string>

namespace mpm {

template <int D>
StressColumns<D> add_stress_columns(Particles& particles) {
    constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    StressColumns<D> columns{};
    for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c] = particles.add_column(std::string("stress_") + names[c]);
    return columns;
}

template StressColumns<2> add_stress_columns<2>(Particles&);
template StressColumns<3> add_stress_columns<3>(Particles&);

}  // namespace mpm
