#include "case_mpi.hpp"

#include <ostream>
#include <type_traits>

namespace rrcb::test {

namespace {

constexpr int bits = 20;
constexpr double one = 1 << bits;

double coordinate(Space space, std::int32_t number) {
    const double unit = number / one;
    switch (space) {
        case Space::lattice:
            return number % 5;
        case Space::unit:
            return unit;
        case Space::far_off:
            return 1e9 + 1e-3 * unit;
        case Space::tiny:
            return number * std::numeric_limits<double>::denorm_min();
        case Space::huge:
            return (2 * unit - 1) * std::numeric_limits<double>::max();
        case Space::decades:
            return (number % 2 == 0 ? 1 : -1) * std::pow(10.0, 180 * unit - 90);
        case Space::clusters:
            return 1e6 * (number % 2) + 1e-6 * unit;
        case Space::flat:
            return -3.5;
    }
    return 0;
}

double weight(Weights weights, std::int32_t number, bool is_first) {
    switch (weights) {
        case Weights::none:
            return 1;
        case Weights::zero:
            return 0;
        case Weights::few_values:
            return number % 4;
        case Weights::decades:
            return std::pow(10.0, 60 * (number / one) - 30);
        case Weights::one_giant:
            return is_first ? 1e6 : 1 + number % 3;
        case Weights::passive:
            return number % 2 == 0 ? 1 : 1e-20;
        case Weights::many_decades:
            return std::pow(10.0, 600 * (number / one) - 300);
        case Weights::subnormal:
            return number % 3 == 0 ? 1e-300
                                   : number % 1000 * std::numeric_limits<double>::denorm_min();
    }
    return 0;
}

/// Another number, far from it, for each copy; itself for copy 0.
std::int32_t displaced(std::int32_t number, std::int32_t copy, std::uint32_t salt) {
    if (copy == 0) return number;
    const auto mixed = static_cast<std::uint32_t>(number) * 2654435761U +
                       static_cast<std::uint32_t>(copy) * (40503U + 2 * salt);
    return static_cast<std::int32_t>((mixed >> 7) % (1U << bits));
}

double size(Sizes sizes, std::int32_t number, std::int32_t part) {
    if (number == 0) return 0;
    const double share = displaced(number, part + 1, 5) / one;
    switch (sizes) {
        case Sizes::few_values:
            return number;
        case Sizes::tiny:
            return number < 3 ? 1e-5 : 1;
        case Sizes::decades:
            return std::pow(10.0, -6 * share);
        case Sizes::many_decades:
            return std::pow(10.0, 600 * share - 300);
        case Sizes::subnormal:
            return number < 4 ? 100 * number * std::numeric_limits<double>::denorm_min() : 1;
    }
    return 0;
}

void append(Cloud& cloud, const Case& input, const Seed& seed, std::int32_t copy) {
    const Case::Shape& shape = input.shape;
    for (std::size_t a = 0; a < static_cast<std::size_t>(shape.dimension); ++a) {
        const auto salt = static_cast<std::uint32_t>(7919 * (a + 1));
        cloud.coordinates.push_back(
            coordinate(shape.spaces[a], displaced(seed.position[a], copy, salt)));
    }
    if (shape.weights != Weights::none)
        cloud.weights.push_back(
            weight(shape.weights, displaced(seed.weight, copy, 1), cloud.weights.empty()));
    cloud.owners.push_back(displaced(seed.owner, copy, 3));
}

int owner(Owners owners, int number, LocalIndex i, LocalIndex count, int num_ranks) {
    if (owners == Owners::scattered) return number % num_ranks;
    if (owners == Owners::one_rank) return num_ranks / 2;
    return static_cast<int>(i * static_cast<LocalIndex>(num_ranks) / count);
}

template <class T>
void broadcast(std::vector<T>& list, MPI_Comm comm) {
    static_assert(std::is_trivially_copyable_v<T>);
    auto size = static_cast<int>(list.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, comm);
    list.resize(static_cast<std::size_t>(size));
    MPI_Bcast(list.data(), size * static_cast<int>(sizeof(T)), MPI_BYTE, 0, comm);
}

}  // namespace

Options Case::options() const {
    Options options{.num_parts = shape.num_parts};
    for (const std::int32_t number : part_sizes)
        options.part_sizes.push_back(
            size(shape.sizes, number, static_cast<std::int32_t>(options.part_sizes.size())));
    options.refine = shape.refine;
    options.expert.cells_per_axis = shape.support_mesh;
    if (shape.central_parts != 0) options.expert.max_root_parts = shape.central_parts;
    options.imbalance_tolerance = shape.tolerance;
    options.expert.axes.plain = shape.plain_cuts != 0;
    options.expert.tree = {shape.group_size, shape.larger_below != 0};
    return options;
}

PaperOptions Case::paper_options() const {
    PaperOptions options{.num_parts = shape.num_parts};
    options.part_sizes = this->options().part_sizes;
    options.domain = shape.choice % 2 == 0 ? PaperDomain::sampled : PaperDomain::points;
    options.cut_rule = shape.choice / 2 % 4 == 0 ? CutRule::midpoint : CutRule::weighted_fraction;
    options.plain_cuts = shape.plain_cuts != 0;
    if (shape.support_mesh != 0) options.cells_per_axis = shape.support_mesh;
    options.sample_fraction = shape.choice / 8 % 2 == 0 ? 1 : 0.25;
    return options;
}

std::ostream& operator<<(std::ostream& out, const Case& input) {
    const Case::Shape& shape = input.shape;
    const auto name = [](auto value) { return static_cast<int>(value); };
    out << "dimension " << shape.dimension << ", spaces " << name(shape.spaces[0])
        << name(shape.spaces[1]) << name(shape.spaces[2]) << ", weights " << name(shape.weights)
        << ", owners " << name(shape.owners) << ", copies " << shape.copies << ", parts "
        << shape.num_parts << " of sizes, kind " << name(shape.sizes) << ", {";
    for (const int size : input.part_sizes) out << ' ' << size;
    out << " }, refine " << name(shape.refine) << ", mesh " << shape.support_mesh
        << ", central parts " << shape.central_parts << ", tolerance " << shape.tolerance
        << ", plain " << shape.plain_cuts << ", groups of " << shape.group_size << ", larger below "
        << shape.larger_below << ", choice " << shape.choice << ", points {";
    for (const Seed& seed : input.seeds) {
        out << " (";
        for (const int number : seed.position) out << number << ' ';
        out << "| " << seed.weight << " on " << seed.owner << ')';
    }
    return out << " }";
}

std::vector<LocalIndex> Cloud::held_by(int rank) const {
    std::vector<LocalIndex> indices;
    for (LocalIndex i = 0; i < size(); ++i)
        if (owners[i] == rank) indices.push_back(i);
    return indices;
}

Cloud Cloud::of_rank(int rank) const {
    Cloud mine;
    mine.dimension = dimension;
    const auto d = static_cast<std::size_t>(dimension);
    for (const LocalIndex i : held_by(rank)) {
        for (std::size_t a = 0; a < d; ++a) mine.coordinates.push_back(coordinates[i * d + a]);
        if (!weights.empty()) mine.weights.push_back(weights[i]);
        mine.owners.push_back(rank);
    }
    return mine;
}

Cloud cloud_of(const Case& input, int num_ranks) {
    Cloud cloud;
    cloud.dimension = input.shape.dimension;
    for (std::int32_t copy = 0; copy < input.shape.copies; ++copy)
        for (const Seed& seed : input.seeds) append(cloud, input, seed, copy);
    for (LocalIndex i = 0; i < cloud.size(); ++i)
        cloud.owners[i] = owner(input.shape.owners, cloud.owners[i], i, cloud.size(), num_ranks);
    return cloud;
}

void broadcast(Case& input, MPI_Comm comm) {
    MPI_Bcast(&input.shape, sizeof input.shape, MPI_BYTE, 0, comm);
    broadcast(input.part_sizes, comm);
    broadcast(input.seeds, comm);
}

}  // namespace rrcb::test
