#include "checks_mpi.hpp"

#include "../support/ranks.hpp"

#include <rrcb/plan.hpp>

namespace rrcb::hard_test {

namespace {

struct Load {
    std::vector<long double> of_parts;
    long double total = 0;
    double heaviest_place = 0;
};

Load load_of(const Cloud& cloud, std::span<const Part> parts, int num_parts) {
    Cloud counted = cloud;
    const int count = static_cast<int>(parts.size());
    const auto is_zero = [&](int i) { return weight_of(cloud, i) == 0; };
    bool weightless = true;
    for (int i = 0; i < count; ++i) weightless = weightless && is_zero(i);
    if (weightless) counted.weight = nullptr;
    Load load{std::vector<long double>(static_cast<std::size_t>(num_parts)), 0,
              heaviest_place(counted, count)};
    for (int i = 0; i < count; ++i) {
        load.of_parts[static_cast<std::size_t>(parts[static_cast<std::size_t>(i)])] +=
            static_cast<long double>(weight_of(counted, i));
        load.total += static_cast<long double>(weight_of(counted, i));
    }
    return load;
}

}  // namespace

std::vector<Part> join_parts(const Share& share, std::span<const Part> parts, int count,
                             int num_parts) {
    std::vector<int> times(static_cast<std::size_t>(count));
    std::vector<Part> all(static_cast<std::size_t>(count));
    EXPECT_EQ(parts.size(), share.numbers.size());
    for (std::size_t k = 0; k < std::min(parts.size(), share.numbers.size()); ++k) {
        const auto point = static_cast<std::size_t>(share.numbers[k]);
        EXPECT_TRUE(parts[k] >= 0 && parts[k] < num_parts) << parts[k];
        ++times[point];
        all[point] = std::clamp(parts[k], 0, num_parts - 1);
    }
    MPI_Allreduce(MPI_IN_PLACE, times.data(), count, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, all.data(), count, MPI_INT32_T, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(std::ranges::count(times, 1), count);
    return all;
}

Share migrated(const Cloud& cloud, std::span<const Part> parts, int num_parts) {
    std::vector<int> owners;
    for (const Part part : parts)
        owners.push_back(ranks_of_part(part, num_parts, num_ranks()).first_rank);
    return share_of(cloud, owners, rank());
}

int count_moves(const Share& share, std::span<const Part> parts, std::span<const Part> before) {
    int moves = 0;
    for (std::size_t k = 0; k < parts.size(); ++k)
        moves += parts[k] != before[static_cast<std::size_t>(share.numbers[k])] ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &moves, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return moves;
}

std::vector<double> numbers_of(const Cuts& cuts) {
    std::vector<double> numbers;
    for (const Cut& cut : cuts.tree) {
        numbers.push_back(cut.axis);
        numbers.insert(numbers.end(), cut.at.begin(), cut.at.end());
    }
    return numbers;
}

void expect_same_on_all_ranks(std::span<const std::byte> values) {
    std::vector<std::byte> of_root(values.begin(), values.end());
    MPI_Bcast(of_root.data(), static_cast<int>(of_root.size()), MPI_BYTE, 0, MPI_COMM_WORLD);
    EXPECT_TRUE(std::ranges::equal(values, of_root)) << "differs from rank 0";
}

void expect_same_in_all(std::span<const std::uint64_t> one, std::span<const std::uint64_t> other) {
    std::uint64_t sums[] = {one.size(), std::accumulate(one.begin(), one.end(), std::uint64_t{0}),
                            other.size(),
                            std::accumulate(other.begin(), other.end(), std::uint64_t{0})};
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(sums[0], sums[2]);
    EXPECT_EQ(sums[1], sums[3]);
}

std::uint64_t journey(std::uint64_t point, int from, int to, Part part) {
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const std::uint64_t value :
         {point, std::uint64_t(from), std::uint64_t(to), std::uint64_t(part)})
        hash = (hash ^ value) * 1099511628211u;
    return hash;
}

void expect_balanced(const Cloud& cloud, std::span<const Part> parts, int num_parts,
                     double tolerance) {
    const Load load = load_of(cloud, parts, num_parts);
    const long double ideal = load.total / num_parts;
    const long double place = static_cast<long double>(load.heaviest_place);
    const long double excess = static_cast<long double>(tolerance - 1) * ideal;
    const long double heaviest = *std::ranges::max_element(load.of_parts);
    const long double most = ideal + (place <= excess ? excess : excess + place);
    EXPECT_LE(heaviest, most * (1 + 1e-12L)) << "ideal " << ideal << ", heaviest place " << place;
}

double imbalance_of(const Cloud& cloud, std::span<const Part> parts, int num_parts) {
    const Load load = load_of(cloud, parts, num_parts);
    if (load.total == 0) return 1;
    return static_cast<double>(*std::ranges::max_element(load.of_parts) * num_parts / load.total);
}

}  // namespace rrcb::hard_test
