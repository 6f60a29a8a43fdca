// Prints a line for each of a set of clouds: what the bits of its cuts and parts add up to. The
// same on every compiler and MPI, which tests/stacks/run compares. With an argument, prints what
// the library is built with.
#include <rrcb/paper.hpp>
#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

namespace {

/// Fowler, Noll and Vo's hash of 64 bits, of numbers in place of bytes.
struct Hash {
    std::uint64_t value = 14695981039346656037u;
    void add(std::uint64_t number) { value = (value ^ number) * 1099511628211u; }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
};

/// Marsaglia's xorshift: the standard library's distributions differ between its makers.
struct Random {
    std::uint64_t state;
    double operator()() {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return static_cast<double>(state >> 11) * 0x1p-53;
    }
};

struct Cloud {
    const char* name;
    int dimension;
    double (*coordinate)(double uniform, int axis);
    bool weighted;
};

constexpr std::array clouds = {
    Cloud{"uniform", 2, [](double u, int) { return u; }, false},
    Cloud{"weighted", 3, [](double u, int) { return u; }, true},
    Cloud{"power law", 2, [](double u, int axis) { return axis == 0 ? u * u * u * u : u; }, true},
    Cloud{"far away", 3, [](double u, int) { return 1e9 + u * 1e-3; }, false},
    Cloud{"lattice", 2, [](double u, int) { return std::floor(u * 20) / 20; }, false},
    Cloud{"large", 1, [](double u, int) { return (u - 0.5) * 1e308; }, true},
    Cloud{"subnormal", 2, [](double u, int) { return u * 1e-310; }, false},
};

constexpr int num_parts = 7;

constexpr std::pair<rrcb::Refine, const char*> refinements[] = {
    {rrcb::Refine::none, "none"},
    {rrcb::Refine::tolerance, "tolerance"},
    {rrcb::Refine::exact, "exact"}};

constexpr std::pair<rrcb::PaperDomain, const char*> paper_domains[] = {
    {rrcb::PaperDomain::sampled, "sampled"}, {rrcb::PaperDomain::points, "points"}};

/// Bits of a balance: cuts, and the parts of all ranks in their order.
std::uint64_t hash_of(const rrcb::Balance& balance) {
    Hash hash;
    for (const rrcb::Cut& cut : balance.cuts.tree) {
        hash.add(static_cast<std::uint64_t>(cut.axis));
        for (const double x : cut.at) hash.add(x);
    }
    Hash mine;
    for (const rrcb::Part part : balance.parts) mine.add(static_cast<std::uint64_t>(part));
    std::uint64_t all = 0;
    MPI_Allreduce(&mine.value, &all, 1, MPI_UINT64_T, MPI_BXOR, MPI_COMM_WORLD);
    hash.add(all);
    return hash.value;
}

/// Prints the bits of a cloud that `balance` divides, a function of points and of their number of
/// parts.
template <class Divide>
void divide(const Cloud& cloud, const char* method, int rank, Divide&& divide_points) {
    Random random{static_cast<std::uint64_t>(rank + 1) * 0x9e3779b97f4a7c15u};
    std::vector<double> coordinates;
    std::vector<double> weights;
    for (int i = 0; i < 4000 + 500 * rank; ++i) {
        for (int axis = 0; axis < cloud.dimension; ++axis)
            coordinates.push_back(cloud.coordinate(random(), axis));
        if (cloud.weighted) weights.push_back(random());
    }
    const std::uint64_t hash =
        hash_of(divide_points(rrcb::Points(coordinates, cloud.dimension, weights)));
    if (rank == 0)
        std::printf("%-10s %-9s %016llx\n", cloud.name, method,
                    static_cast<unsigned long long>(hash));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) return std::fputs(rrcb::build_info(), stdout) < 0;
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    for (const Cloud& cloud : clouds) {
        for (const auto& [refine, name] : refinements)
            divide(cloud, name, rank, [&, refine = refine](const rrcb::Points& points) {
                rrcb::Options options;
                options.refine = refine;
                options.num_parts = num_parts;
                return rrcb::balance(points, MPI_COMM_WORLD, options);
            });
        for (const auto& [domain, name] : paper_domains)
            divide(cloud, name, rank, [&, domain = domain](const rrcb::Points& points) {
                rrcb::PaperOptions options;
                options.domain = domain;
                options.num_parts = num_parts;
                return rrcb::balance_as_in_paper(points, MPI_COMM_WORLD, options);
            });
    }
    MPI_Finalize();
}
