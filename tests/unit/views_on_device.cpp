// Must not compile: the view is in memory that the host cannot read.
#include <rrcb/points.hpp>

struct DeviceMemory {};
struct HostMemory {};

template <class Memory>
struct View {
    using memory_space = Memory;
    using HostMirror = View<HostMemory>;
    static constexpr int Rank = 1;
    int extent(int) const { return 0; }
    int stride(int) const { return 1; }
    const double* data() const { return nullptr; }
};

rrcb::Points read(const View<HostMemory>& x, const View<MEMORY>& y) {
    return rrcb::Points(x, y);
}
