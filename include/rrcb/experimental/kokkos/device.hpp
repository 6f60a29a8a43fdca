#pragma once

#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

namespace rrcb::detail {

/// Throws Error unless a condition is true.
inline void require_on_device(bool holds, const std::string& what) {
    if (!holds) throw Error(ErrorCode::invalid_argument, what);
}

inline void require_kokkos() {
    require_on_device(Kokkos::is_initialized(),
                      "Kokkos is not initialized; call Kokkos::initialize() before, and "
                      "Kokkos::finalize() after all calls with views");
}

/// True for execution spaces that run on the host.
template <class Execution>
inline constexpr bool runs_on_host =
    std::is_same_v<typename Execution::memory_space, Kokkos::HostSpace>;

/// Returns a lock for kernels that use scratch memory, because before Kokkos 4 all threads of a
/// host share one scratch memory.
template <class Execution>
std::unique_lock<std::mutex> lock_scratch() {
    static std::mutex mutex;
    if constexpr (runs_on_host<Execution> && KOKKOS_VERSION < 40000)
        return std::unique_lock(mutex);
    else
        return {};
}

/// An instance of an execution space, and memory that the steps of a call share. Views of this
/// memory are valid until the next fence.
template <class Space, class MemorySpace>
class Device {
  public:
    using Execution = Space;
    using Memory = MemorySpace;
    template <class T>
    using Lent = Kokkos::View<T*, Memory, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    /// Uses the memory of an earlier call, if it is given; see memory().
    explicit Device(const Execution& exec, const Kokkos::View<char*, Memory>& memory = {})
        : exec_(exec), memory_(memory) {}

    const Execution& exec() const { return exec_; }
    const Kokkos::View<char*, Memory>& memory() const { return memory_; }

    /// Returns a length of blocks with which each worker, a team of `threads`, gets four of the
    /// blocks of `count` points.
    std::int64_t block_length(std::int64_t count, int threads) const {
        const std::int64_t workers = std::max(static_cast<int>(exec_.concurrency()) / threads, 1);
        return count / (4 * workers) + 1;
    }

    /// Returns the range of indices 0 ... count - 1 for a kernel, with 64 bits.
    template <class Count>
    auto range(Count count) const {
        return Kokkos::RangePolicy<Execution, Kokkos::IndexType<std::int64_t>>(
            exec_, 0, static_cast<std::int64_t>(count));
    }

    /// Returns newly allocated memory. Throws std::bad_alloc.
    template <class T>
    Kokkos::View<T*, Memory> allocate(std::size_t size) const {
        try {
            const std::string name = "rrcb";
            return Kokkos::View<T*, Memory>(
                Kokkos::view_alloc(exec_, name, Kokkos::WithoutInitializing), size);
        } catch (const std::exception&) {
            // The type of the exception depends on the version of Kokkos.
            throw std::bad_alloc();
        }
    }

    /// Returns a part of the shared memory. Throws std::bad_alloc.
    template <class T>
    Lent<T> lend(std::size_t size) {
        const std::size_t bytes = (size * sizeof(T) + alignment - 1) / alignment * alignment;
        if (lent_ + bytes > memory_.extent(0)) {
            full_.push_back(memory_);
            memory_ = allocate<char>(std::max(bytes, least_bytes));
            lent_ = 0;
        }
        T* const first = reinterpret_cast<T*>(memory_.data() + lent_);
        lent_ += bytes;
        return Lent<T>(first, size);
    }

    /// Returns a copy of numbers of the host on the device. The numbers must remain until the next
    /// fence.
    template <class Values>
    auto copy_in(const Values& values) {
        using T = typename Values::value_type;
        const Lent<T> view = lend<T>(values.size());
        if (!values.empty())
            Kokkos::deep_copy(exec_, view, OnHost<const T>(values.data(), values.size()));
        return view;
    }
    /// Returns a copy on the host. Ends with a fence.
    template <class View>
    auto copy_out(const View& view) {
        using T = typename View::non_const_value_type;
        std::vector<T> values(view.extent(0));
        if (!values.empty())
            Kokkos::deep_copy(exec_, OnHost<T>(values.data(), values.size()), view);
        fence();
        return values;
    }

    void fence() {
        exec_.fence();
        full_.clear();
        lent_ = 0;
    }

  private:
    template <class T>
    using OnHost = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    static constexpr std::size_t alignment = 64;
    static constexpr std::size_t least_bytes = 1 << 18;  // enough for the default mesh

    Execution exec_;
    Kokkos::View<char*, Memory> memory_{};
    std::size_t lent_ = 0;  ///< bytes in use
    std::vector<Kokkos::View<char*, Memory>> full_{};
};

/// Unsigned integers for which all devices have an instruction for atomic addition; unsigned long
/// long does not have one in each Kokkos. Negative numbers wrap around.
using Word = std::uint64_t;

/// Largest number of points that a team adds up in one word per bin: it can hold 2^15 numbers below
/// 2^47.
inline constexpr std::int64_t most_in_block = 1 << 15;

/// Number of consecutive points that a thread of a team reads in turn; as doubles they are a sector
/// of 32 bytes.
inline constexpr int run_length = 4;

/// The numbers that a point adds to consecutive bins.
template <int Fields>
struct Row {
    static constexpr std::int64_t none = INT64_MIN;

    std::int64_t bin;  ///< first bin; none: the point adds nothing. Values of 0 need no bin
    std::int64_t values[Fields];
};

/// Sums of integers in bins. They are exact, so that they do not depend on the order. Each sum over
/// all blocks has two words, for the higher and the lower bits, and can hold 2^40 numbers.
template <class Execution>
struct Bins {
    static constexpr int low_bits = 24;
    static constexpr Word low_mask = (Word{1} << low_bits) - 1;

    /// A word in scratch memory, where devices can add only 32 bits atomically.
    struct Halves {
        std::uint32_t low, high;
    };
    using Scratch = std::conditional_t<runs_on_host<Execution>, Word, Halves>;

    Scratch* of_block;  ///< null if only the sums over all blocks are used
    Word* of_all;

    KOKKOS_INLINE_FUNCTION void add(std::int64_t bin, std::int64_t value) const {
        if (of_block == nullptr)
            add_to_all(bin, value);
        else if constexpr (runs_on_host<Execution>)
            of_block[bin] += static_cast<Word>(value);
        else
            add_in_halves(of_block[bin], static_cast<Word>(value));
    }
    KOKKOS_INLINE_FUNCTION static void add_in_halves(Halves& word, Word value) {
        const auto low = static_cast<std::uint32_t>(value);
        auto high = static_cast<std::uint32_t>(value >> 32);
        if (low != 0 && Kokkos::atomic_fetch_add(&word.low, low) > UINT32_MAX - low) ++high;
        if (high != 0) Kokkos::atomic_add(&word.high, high);
    }
    /// Adds the sum of a bin in this block to the sum over all blocks.
    KOKKOS_INLINE_FUNCTION void finish(std::int64_t bin) const {
        Word sum = 0;
        if constexpr (runs_on_host<Execution>)
            sum = of_block[bin];
        else
            sum = Word{of_block[bin].high} << 32 | of_block[bin].low;
        add_to_all(bin, static_cast<std::int64_t>(sum));
    }
    KOKKOS_INLINE_FUNCTION void add_to_all(std::int64_t bin, std::int64_t value) const {
        const Word low = static_cast<Word>(value) & low_mask;
        const auto high = static_cast<Word>(value >> low_bits);
        if (high != 0) Kokkos::atomic_add(&of_all[2 * bin], high);
        if (low != 0) Kokkos::atomic_add(&of_all[2 * bin + 1], low);
    }
    static double total(Word high, Word low) {
        high += low >> low_bits;
        return static_cast<double>(static_cast<std::int64_t>(high)) * (low_mask + 1) +
               static_cast<double>(low & low_mask);
    }
};

/// Rows of the points of one thread. On a device, rows of equal bins are first added up in
/// registers: neighbours in memory are often neighbours in space, and would otherwise wait for the
/// same word.
template <class Execution, int Fields>
struct Rows {
    Bins<Execution> bins;
    Row<Fields> sum{Row<Fields>::none, {}};

    KOKKOS_INLINE_FUNCTION void add(const Row<Fields>& row) {
        if (row.bin == row.none) return;
        if (runs_on_host<Execution>) return add_to_bins(row);
        if (row.bin != sum.bin) {
            finish();
            sum = row;
        } else {
            for (int f = 0; f < Fields; ++f) sum.values[f] += row.values[f];
        }
    }
    KOKKOS_INLINE_FUNCTION void finish() const {
        if (sum.bin != sum.none) add_to_bins(sum);
    }

  private:
    KOKKOS_INLINE_FUNCTION void add_to_bins(const Row<Fields>& row) const {
        for (int f = 0; f < Fields; ++f)
            if (row.values[f] != 0) bins.add(row.bin + f, row.values[f]);
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

/// Adds the rows body(i), for i = 0 ... count - 1, to bins whose sums are in `of_all`.
template <class Device, class Body>
void add_in_bins(const Device& device, std::int64_t count, std::int64_t num_bins, Word* of_all,
                 const Body& body) {
    using Execution = typename Device::Execution;
    using Policy = Kokkos::TeamPolicy<Execution>;
    const int in_block =
        num_bins <= bins_in_scratch(device.exec()) ? static_cast<int>(num_bins) : 0;
    const int bytes = in_block * static_cast<int>(sizeof(Word));
    // There are enough blocks to occupy the whole device, but a block has at least as many points
    // as bins.
    const std::int64_t length =
        std::clamp(device.block_length(count, runs_on_host<Execution> ? 1 : 1024),
                   std::clamp<std::int64_t>(in_block, 1024, most_in_block), most_in_block);
    const int teams = static_cast<int>((count + length - 1) / length);
    if (teams == 0) return;
    Policy policy(device.exec(), teams, Kokkos::AUTO);
    if constexpr (runs_on_host<Execution>) policy = Policy(device.exec(), teams, 1);
    if (in_block > 0)
        policy.set_scratch_size(scratch_level<Execution>, Kokkos::PerTeam(bytes + 64));
    const auto lock = lock_scratch<Execution>();
    Kokkos::parallel_for(
        "rrcb::add_in_bins", policy, KOKKOS_LAMBDA(const typename Policy::member_type& team) {
            const std::int64_t first = team.league_rank() * length;
            const std::int64_t end = first + length < count ? first + length : count;
            Bins<Execution> bins{nullptr, of_all};
            if (in_block > 0)
                bins.of_block = static_cast<typename Bins<Execution>::Scratch*>(
                    team.team_scratch(runs_on_host<Execution> ? 1 : 0).get_shmem(bytes));
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block),
                                 [&](int bin) { bins.of_block[bin] = {}; });
            team.team_barrier();
            const Body row_of = body;  // a copy, which the compiler keeps in registers
            Rows<Execution, Body::fields> rows{bins};
            for (std::int64_t i = first + team.team_rank() * run_length; i < end;
                 i += team.team_size() * run_length)
                for (int k = 0; k < run_length; ++k)
                    if (i + k < end) rows.add(row_of(i + k));
            rows.finish();
            team.team_barrier();
            Kokkos::parallel_for(Kokkos::TeamThreadRange(team, in_block),
                                 [&](int bin) { bins.finish(bin); });
        });
}

/// Returns the sums of the rows of each body, one body after the other. Ends with a fence.
template <class Device, class Body>
std::vector<double> sum_in_bins(Device& device, std::int64_t count, std::int64_t num_bins,
                                const std::vector<Body>& bodies) {
    const std::size_t num_words = 2 * static_cast<std::size_t>(num_bins);
    const auto sums = device.template lend<Word>(num_words * bodies.size());
    Kokkos::deep_copy(device.exec(), sums, 0);
    for (std::size_t k = 0; k < bodies.size(); ++k)
        add_in_bins(device, count, num_bins, sums.data() + num_words * k, bodies[k]);
    const std::vector<Word> words = device.copy_out(sums);
    std::vector<double> totals;
    for (std::size_t k = 0; k < words.size(); k += 2)
        totals.push_back(Bins<typename Device::Execution>::total(words[k], words[k + 1]));
    return totals;
}

}  // namespace rrcb::detail
