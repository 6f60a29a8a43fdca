#pragma once

#include <rrcb/kokkos/points.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

/// Sums of integers in bins, exact and so the same in any order: two words for each, the higher
/// and the lower bits, hold sums of 2^40 numbers.
template <bool is_alone>
struct Bins {
    static constexpr int low_bits = 24;

    Word* of_block;  ///< of the points of this team, a word for each; null: only those of all
    Word* of_all;

    KOKKOS_INLINE_FUNCTION void add(std::int64_t bin, std::int64_t value) const {
        if (of_block == nullptr) {
            add_to_all(bin, value);
        } else if constexpr (is_alone) {
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
    static double value(Word high_word, Word low_word) {
        const std::int64_t high =
            static_cast<std::int64_t>(high_word) + static_cast<std::int64_t>(low_word >> low_bits);
        const Word low = low_word & ((Word{1} << low_bits) - 1);
        return std::ldexp(static_cast<double>(high), low_bits) + static_cast<double>(low);
    }
};

/// A kernel in which each team adds up a block of points. `Body` is called with the index of a
/// point and Bins.
template <class Execution, class Body>
struct SumOfBlocks {
    static constexpr bool is_alone = runs_on_host<Execution>;
    // Each thread of a host has memory of its own for a team; scratch of a device is fast at 0.
    static constexpr int level = is_alone ? 1 : 0;
    using Policy = Kokkos::TeamPolicy<Execution>;

    Body body;
    std::int64_t count;
    std::int64_t num_bins;
    Word* of_all;
    bool has_scratch;

    KOKKOS_INLINE_FUNCTION void operator()(const typename Policy::member_type& team) const {
        const std::int64_t first = static_cast<std::int64_t>(team.league_rank()) * block_length;
        const std::int64_t rest = count - first;
        const int length = static_cast<int>(rest < block_length ? rest : block_length);
        Bins<is_alone> bins{nullptr, of_all};
        if (has_scratch) {
            bins.of_block =
                static_cast<Word*>(team.team_scratch(is_alone ? 1 : 0)
                                       .get_shmem(static_cast<int>(num_bins * sizeof(Word))));
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, static_cast<int>(num_bins)),
                                 [&](int bin) { bins.of_block[bin] = 0; });
            team.team_barrier();
        }
        Kokkos::parallel_for(Kokkos::TeamThreadRange(team, length),
                             [&](int k) { body(first + k, bins); });
        if (!has_scratch) return;
        team.team_barrier();
        Kokkos::parallel_for(
            Kokkos::TeamThreadRange(team, static_cast<int>(num_bins)),
            [&](int bin) { bins.add_to_all(bin, static_cast<std::int64_t>(bins.of_block[bin])); });
    }
};

/// Returns true if a team has fast memory for so many bins.
template <class Execution>
bool fits_scratch(const Execution& exec, std::int64_t num_bins) {
    using Sum = SumOfBlocks<Execution, int>;
    const typename Sum::Policy policy(exec, 1, 1);
    return num_bins * static_cast<std::int64_t>(sizeof(Word)) + 64 <=
           policy.scratch_size_max(Sum::level);
}

/// Adds up points 0 ... count - 1 in bins; returns the sums. `extra` words behind them, zeros at
/// first, are for the body, and come to the host with them. A fence.
///
/// @param body made by make_body(pointer to the extra words)
template <class Memory, class Execution, class MakeBody>
std::vector<double> sum_in_bins(const Execution& exec, std::int64_t count, std::int64_t num_bins,
                                std::span<Word> extra, const MakeBody& make_body) {
    const std::size_t size = 2 * static_cast<std::size_t>(num_bins);
    const auto sums = allocate<Word, Memory>(exec, size + extra.size(), true);
    auto body = make_body(sums.data() + size);
    using Sum = SumOfBlocks<Execution, decltype(body)>;
    const bool has_scratch = num_bins > 0 && fits_scratch(exec, num_bins);
    const int teams = static_cast<int>((count + block_length - 1) / block_length);
    const auto run = [&](auto&& policy) {
        if (teams == 0) return;
        if (has_scratch)
            policy.set_scratch_size(
                Sum::level, Kokkos::PerTeam(static_cast<int>(num_bins * sizeof(Word)) + 64));
        Kokkos::parallel_for("rrcb::sum_in_bins", policy,
                             Sum{body, count, num_bins, sums.data(), has_scratch});
    };
    if constexpr (Sum::is_alone) {
        run(typename Sum::Policy(exec, teams, 1));
    } else {
        run(typename Sum::Policy(exec, teams, Kokkos::AUTO));
    }
    std::vector<Word> words(size + extra.size());
    copy_out(exec, sums, std::span(words));
    exec.fence();
    std::copy(words.begin() + static_cast<std::ptrdiff_t>(size), words.end(), extra.begin());
    std::vector<double> totals(static_cast<std::size_t>(num_bins));
    for (std::size_t bin = 0; bin < totals.size(); ++bin)
        totals[bin] = Bins<true>::value(words[2 * bin], words[2 * bin + 1]);
    return totals;
}

}  // namespace rrcb::detail
