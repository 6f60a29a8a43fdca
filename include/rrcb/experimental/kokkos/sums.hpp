#pragma once

#include <rrcb/experimental/kokkos/device.hpp>

#include <cmath>

namespace rrcb::detail {

/// Unsigned integers for which all devices have an instruction for atomic addition; unsigned long
/// long does not have one in each Kokkos. Negative numbers wrap around.
using Word = std::uint64_t;

/// Number of bits in the lower word of a sum over all blocks. With a second word for the higher
/// bits, a sum can hold 2^40 integers below 2^47.
inline constexpr int low_bits = 24;
inline constexpr Word low_mask = (Word{1} << low_bits) - 1;

/// Largest number of points that a team adds up in one word per bin: it can hold 2^15 integers
/// below 2^47.
inline constexpr std::int64_t most_in_block = 1 << 15;

/// Number of consecutive points that a thread of a team reads in turn; as doubles they are a sector
/// of 32 bytes.
inline constexpr int run_length = 4;

/// The integers that a point adds to consecutive bins.
template <int Fields>
struct Row {
    static constexpr std::int64_t none = INT64_MIN;

    std::int64_t bin;  ///< first bin; none: the point adds nothing. Values of 0 need no bin
    std::int64_t values[Fields];
};

/// A sum in scratch memory of a device, where threads can add only 32 bits atomically.
struct HalvedSum {
    std::uint32_t low, high;

    KOKKOS_INLINE_FUNCTION void operator+=(Word value) {
        const auto lower = static_cast<std::uint32_t>(value);
        auto upper = static_cast<std::uint32_t>(value >> 32);
        if (lower != 0 && Kokkos::atomic_fetch_add(&low, lower) > UINT32_MAX - lower) ++upper;
        if (upper != 0) Kokkos::atomic_add(&high, upper);
    }
    KOKKOS_INLINE_FUNCTION explicit operator Word() const { return Word{high} << 32 | low; }
};

/// Sums of integers in bins. They are exact, so that they do not depend on the order.
template <class Execution, int Fields>
struct Bins {
    // On the host, a team is one thread.
    using Sum = std::conditional_t<runs_on_host<Execution>, Word, HalvedSum>;

    Sum* of_block;  ///< null if only the sums over all blocks are used
    Word* of_all;   ///< two words for each bin, the higher bits first
    Row<Fields> run{};

    /// Adds the row of a point. On a device, consecutive rows of equal bins are first added up in
    /// registers: neighbours in memory are often neighbours in space, and would otherwise wait for
    /// the same word. The last of them remain in `run`.
    KOKKOS_INLINE_FUNCTION void add(const Row<Fields>& row) {
        if (row.bin == row.none) return;
        if (runs_on_host<Execution>) return add_to_bins(row);
        if (row.bin != run.bin) {
            add_to_bins(run);
            run = row;
        } else {
            for (int f = 0; f < Fields; ++f) run.values[f] += row.values[f];
        }
    }
    /// Adds a number to the sum over all blocks.
    KOKKOS_INLINE_FUNCTION void add_to_all(std::int64_t bin, std::int64_t value) const {
        const auto low = static_cast<Word>(value) & low_mask;
        const auto high = static_cast<Word>(value >> low_bits);
        if (high != 0) Kokkos::atomic_add(&of_all[2 * bin], high);
        if (low != 0) Kokkos::atomic_add(&of_all[2 * bin + 1], low);
    }
    KOKKOS_INLINE_FUNCTION void add_to_bins(const Row<Fields>& row) const {
        for (int f = 0; f < Fields; ++f) {
            if (row.values[f] == 0) continue;
            if (of_block == nullptr)
                add_to_all(row.bin + f, row.values[f]);
            else
                of_block[row.bin + f] += static_cast<Word>(row.values[f]);
        }
    }
};

// On the host a thread is a team with its own memory, so level 1 is used; on a device the scratch
// memory of level 0 is fast.
template <class Execution>
inline constexpr int scratch_level = runs_on_host<Execution> ? 1 : 0;

/// Returns the number of bins for which a team has fast memory; at most the number of points that
/// it adds.
template <class Execution>
std::int64_t bins_in_scratch(const Execution& exec) {
    const Kokkos::TeamPolicy<Execution> policy(exec, 1, 1);
    const int bytes = policy.scratch_size_max(scratch_level<Execution>) - 64;
    return std::min<std::int64_t>(bytes / static_cast<int>(sizeof(Word)), 8 * most_in_block);
}

/// Adds the rows row_of(i), for i = 0 ... count - 1, to bins whose sums are in `of_all`.
template <class Device, class Rows>
void add_in_bins(const Device& device, std::int64_t count, std::int64_t num_bins, Word* of_all,
                 const Rows& row_of) {
    using Execution = typename Device::Execution;
    using Policy = Kokkos::TeamPolicy<Execution>;
    using Bins = detail::Bins<Execution, Rows::fields>;
    const int in_block =
        num_bins <= bins_in_scratch(device.exec()) ? static_cast<int>(num_bins) : 0;
    const int bytes = in_block * static_cast<int>(sizeof(Word));
    // Each team that runs at a time gets four blocks, but a block has at least as many points as
    // bins.
    const int threads = runs_on_host<Execution> ? 1 : 1024;
    const int workers = std::max(static_cast<int>(device.exec().concurrency()) / threads, 1);
    const std::int64_t length =
        std::clamp(count / (4 * workers) + 1,
                   std::clamp<std::int64_t>(in_block, 1024, most_in_block), most_in_block);
    const int teams = static_cast<int>((count + length - 1) / length);
    if (teams == 0) return;
    Policy policy = runs_on_host<Execution> ? Policy(device.exec(), teams, 1)
                                            : Policy(device.exec(), teams, Kokkos::AUTO);
    if (in_block > 0)
        policy.set_scratch_size(scratch_level<Execution>, Kokkos::PerTeam(bytes + 64));
    const auto lock = lock_scratch<Execution>();
    Kokkos::parallel_for(
        "rrcb::add_in_bins", policy, KOKKOS_LAMBDA(const typename Policy::member_type& team) {
            const std::int64_t first = team.league_rank() * length;
            const std::int64_t end = first + length < count ? first + length : count;
            Bins bins{nullptr, of_all};
            if (in_block > 0)
                bins.of_block = static_cast<typename Bins::Sum*>(
                    team.team_scratch(runs_on_host<Execution> ? 1 : 0).get_shmem(bytes));
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block),
                                 [&](int bin) { bins.of_block[bin] = {}; });
            team.team_barrier();
            const Rows row = row_of;  // a copy, which the compiler keeps in registers
            for (std::int64_t i = first + team.team_rank() * run_length; i < end;
                 i += team.team_size() * run_length)
                for (int k = 0; k < run_length; ++k)
                    if (i + k < end) bins.add(row(i + k));
            bins.add_to_bins(bins.run);
            team.team_barrier();
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block), [&](int bin) {
                bins.add_to_all(bin, static_cast<std::int64_t>(Word(bins.of_block[bin])));
            });
        });
}

/// Returns the sums of the rows of all points. Ends with a fence.
template <class Device, class Rows>
std::vector<double> sum_in_bins(Device& device, std::int64_t count, std::int64_t num_bins,
                                const Rows& row_of) {
    const auto sums = device.template lend<Word>(2 * static_cast<std::size_t>(num_bins));
    Kokkos::deep_copy(device.exec(), sums, 0);
    add_in_bins(device, count, num_bins, sums.data(), row_of);
    const std::vector<Word> words = device.copy_out(sums);
    std::vector<double> totals;
    for (std::size_t k = 0; k < words.size(); k += 2) {
        const auto high = static_cast<std::int64_t>(words[k] + (words[k + 1] >> low_bits));
        const auto low = static_cast<double>(words[k + 1] & low_mask);
        totals.push_back(std::ldexp(static_cast<double>(high), low_bits) + low);
    }
    return totals;
}

}  // namespace rrcb::detail
