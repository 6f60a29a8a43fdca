#pragma once

#include <rrcb/kokkos/device.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

/// Integers that atomic operations of all devices add; negative numbers wrap.
using Word = unsigned long long;

/// Points that a team adds up in a word for each bin: up to 2^15 numbers below 2^47.
inline constexpr int block_length = 1 << 15;

/// Sums of integers in bins, exact and so the same in any order. Sums of all blocks have two words,
/// for the higher and the lower bits, and hold 2^40 numbers.
template <class Execution>
struct Bins {
    static constexpr int low_bits = 24;

    Word* of_block;  ///< a word for each; null: only those of all
    Word* of_all;

    KOKKOS_INLINE_FUNCTION void add(std::int64_t bin, std::int64_t value) const {
        if (of_block == nullptr) {
            add_to_all(bin, value);
        } else if constexpr (runs_on_host<Execution>) {
            of_block[bin] += static_cast<Word>(value);
        } else {
            Kokkos::atomic_fetch_add(&of_block[bin], static_cast<Word>(value));
        }
    }
    KOKKOS_INLINE_FUNCTION void add_to_all(std::int64_t bin, std::int64_t value) const {
        const auto low = static_cast<Word>(value) & ((Word{1} << low_bits) - 1);
        const std::int64_t high = value >> low_bits;
        if (high != 0) Kokkos::atomic_fetch_add(&of_all[2 * bin], static_cast<Word>(high));
        if (low != 0) Kokkos::atomic_fetch_add(&of_all[2 * bin + 1], low);
    }
    static double total(Word high_word, Word low_word) {
        const std::int64_t high =
            static_cast<std::int64_t>(high_word) + static_cast<std::int64_t>(low_word >> low_bits);
        const Word low = low_word & ((Word{1} << low_bits) - 1);
        return std::ldexp(static_cast<double>(high), low_bits) + static_cast<double>(low);
    }
};

// A thread of the host is a team, with memory of its own; the scratch of a device is fast at 0.
template <class Execution>
inline constexpr int scratch_level = runs_on_host<Execution> ? 1 : 0;

/// Returns the number of bins for which a team has fast memory.
template <class Execution>
std::int64_t bins_in_scratch(const Execution& exec) {
    const Kokkos::TeamPolicy<Execution> policy(exec, 1, 1);
    return (policy.scratch_size_max(scratch_level<Execution>) - 64) /
           static_cast<std::int64_t>(sizeof(Word));
}

/// Calls body(i, bins) for i = 0 ... count - 1, which adds to bins whose sums are in `of_all`.
template <class Device, class Body>
void add_in_bins(const Device& device, std::int64_t count, std::int64_t num_bins, Word* of_all,
                 const Body& body) {
    using Execution = typename Device::Execution;
    using Policy = Kokkos::TeamPolicy<Execution>;
    const bool has_scratch = num_bins <= bins_in_scratch(device.exec());
    const int bytes = has_scratch ? static_cast<int>(num_bins * sizeof(Word)) : 0;
    const int teams = static_cast<int>(count / block_length) + 1;
    Policy policy(device.exec(), teams, Kokkos::AUTO);
    if constexpr (runs_on_host<Execution>) policy = Policy(device.exec(), teams, 1);
    if (has_scratch) policy.set_scratch_size(scratch_level<Execution>, Kokkos::PerTeam(bytes + 64));
    Kokkos::parallel_for(
        "rrcb::add_in_bins", policy, KOKKOS_LAMBDA(const typename Policy::member_type& team) {
            const std::int64_t first = static_cast<std::int64_t>(team.league_rank()) * block_length;
            const std::int64_t rest = count - first;
            const int length = static_cast<int>(rest < block_length ? rest : block_length);
            const int in_block = bytes / static_cast<int>(sizeof(Word));
            Bins<Execution> bins{nullptr, of_all};
            if (has_scratch)
                bins.of_block = static_cast<Word*>(
                    team.team_scratch(runs_on_host<Execution> ? 1 : 0).get_shmem(bytes));
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block),
                                 [&](int bin) { bins.of_block[bin] = 0; });
            team.team_barrier();
            const Body add = body;  // a copy, which stays in registers
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, length),
                                 [&](int k) { add(first + k, bins); });
            team.team_barrier();
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block), [&](int bin) {
                bins.add_to_all(bin, static_cast<std::int64_t>(bins.of_block[bin]));
            });
        });
}

/// Returns the sums in bins. A fence.
template <class Device, class View>
std::vector<double> totals_of_bins(Device& device, const View& sums) {
    std::vector<Word> words(sums.extent(0));
    device.copy_out(sums, std::span(words));
    device.fence();
    std::vector<double> totals(words.size() / 2);
    for (std::size_t bin = 0; bin < totals.size(); ++bin)
        totals[bin] = Bins<typename Device::Execution>::total(words[2 * bin], words[2 * bin + 1]);
    return totals;
}

/// Returns the sums of what body(i, bins) adds for i = 0 ... count - 1. A fence.
template <class Device, class Body>
std::vector<double> sum_in_bins(Device& device, std::int64_t count, std::int64_t num_bins,
                                const Body& body) {
    const auto sums = device.template lend_zeros<Word>(2 * static_cast<std::size_t>(num_bins));
    add_in_bins(device, count, num_bins, sums.data(), body);
    return totals_of_bins(device, sums);
}

}  // namespace rrcb::detail
