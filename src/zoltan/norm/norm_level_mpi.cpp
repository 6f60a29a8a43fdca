#include "zoltan/norm/norm_level_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <bit>

namespace rrcb::zoltan {

namespace {

constexpr std::size_t least_slots = 8;
constexpr std::size_t most_slots = 128;

/// Slots of all searches together. More where each of many searches gets the least number.
constexpr std::size_t enough_slots = 8192;

/// Slots of each search, a power of 2.
std::size_t slots_for(std::size_t num_searches) {
    const std::size_t fair = enough_slots / std::max<std::size_t>(1, num_searches);
    return std::bit_floor(std::clamp(fair, least_slots, most_slots));
}

}  // namespace

LevelMessages::LevelMessages(std::size_t most_searches)
    : ranges_(most_searches),
      counting_(most_searches),
      slots_(std::max(enough_slots, most_searches * least_slots)) {}

void LevelMessages::add_up(std::span<Load> loads, MPI_Comm comm) {
    constexpr std::size_t entries = std::tuple_size_v<Load>;
    static_assert(sizeof(Load) == entries * sizeof(std::int64_t));
    const int size = mpi::to_int(static_cast<std::int64_t>(loads.size() * entries));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, loads.data(), size, MPI_INT64_T, MPI_SUM, comm),
               "MPI_Allreduce");
}

void LevelMessages::find_ranges(std::span<LevelSearch> searches, const NormObjects& objects,
                                MPI_Comm comm) {
    std::size_t num_ranges = 0;
    for (const LevelSearch& s : searches) {
        if (s.search.is_done()) continue;
        const auto list = objects.listed(s.range, s.search.axis(), s.length);
        ranges_[num_ranges++] = objects.key_range(list, s.search.current_axis());
    }
    static_assert(sizeof(KeyRange) == 2 * sizeof(std::int64_t));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, ranges_.data(),
                             mpi::to_int(static_cast<std::int64_t>(2 * num_ranges)), MPI_INT64_T,
                             MPI_MAX, comm),
               "MPI_Allreduce");
    std::size_t k = 0;
    counting_.clear();
    for (std::size_t n = 0; n < searches.size(); ++n) {
        if (searches[n].search.is_done()) continue;
        if (searches[n].search.narrow(ranges_[k++]))
            counting_.push_back(static_cast<std::uint32_t>(n));
    }
}

void LevelMessages::count_slots(std::span<LevelSearch> searches, NormObjects& objects,
                                MPI_Comm comm) {
    if (counting_.empty()) return;
    const std::size_t most = slots_for(counting_.size());
    const std::span<Load> slots = std::span(slots_).first(counting_.size() * most);
    std::ranges::fill(slots, Load{});
    for (std::size_t k = 0; k < counting_.size(); ++k) {
        const LevelSearch& s = searches[counting_[k]];
        objects.count(objects.listed(s.range, s.search.axis(), s.length), s.search.current_axis(),
                      s.search.bins(static_cast<int>(most)), slots.subspan(k * most, most));
    }
    add_up(slots, comm);
    for (std::size_t k = 0; k < counting_.size(); ++k) {
        LevelSearch& s = searches[counting_[k]];
        // Asked before choose(), which changes the bins of the search.
        const Bins bins = s.search.bins(static_cast<int>(most));
        const int slot = s.search.choose(slots.subspan(k * most, most));
        s.length =
            objects.keep(s.range, s.search.axis(), s.length, s.search.current_axis(), bins, slot);
    }
}

int LevelMessages::run(std::span<LevelSearch> searches, NormObjects& objects, MPI_Comm comm) {
    const auto open = [](const LevelSearch& s) { return !s.search.is_done(); };
    int rounds = 0;
    while (std::ranges::any_of(searches, open)) {
        find_ranges(searches, objects, comm);
        count_slots(searches, objects, comm);
        ++rounds;
    }
    return rounds;
}

}  // namespace rrcb::zoltan
