#include "zoltan/handle/serialization.hpp"

#include "collective/saved_state.hpp"
#include "zoltan/real/message.hpp"

#include <rrcb/restart.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace rrcb::zoltan {

namespace {

constexpr std::array<char, 8> signature = {'R', 'R', 'C', 'B', 'h', 'n', 'd', '7'};

/// Beginning of a parcel. The saved state of `size` bytes follows.
struct Header {
    std::array<char, 8> signature = zoltan::signature;
    std::uint64_t size = 0;
};

[[noreturn]] void refuse(const char* why) {
    throw_fatal(std::string("the buffer of Zoltan_Serialize is ") + why);
}

/// Writes or reads a list; store_entry() does so for each entry.
template <class Entry, class StoreEntry>
void store_list(SavedState& saved, std::vector<Entry>& list, StoreEntry store_entry) {
    std::size_t size = list.size();
    saved.count(size, saved.num_left());
    list.resize(size);
    for (Entry& entry : list) store_entry(entry);
}

/// Writes or reads bytes, eight of them in a word.
template <class Bytes>
void store_bytes(SavedState& saved, Bytes& bytes) {
    std::size_t size = bytes.size();
    std::vector<std::uint64_t> words((size + 7) / 8);
    std::ranges::copy(std::as_bytes(std::span(bytes)),
                      std::as_writable_bytes(std::span(words)).begin());
    saved.each(size);
    store_list(saved, words, [&](std::uint64_t& word) { saved.each(word); });
    bytes.resize(std::min(size, 8 * words.size()));
    const auto stored = std::as_bytes(std::span(words)).first(bytes.size());
    std::ranges::copy(stored, std::as_writable_bytes(std::span(bytes)).begin());
}

bool is_permutation(std::vector<Part> numbers) {
    std::ranges::sort(numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] != static_cast<Part>(i)) return false;
    }
    return true;
}

bool is_consistent(const PartMap& map) {
    const auto valid_range = [](const RankRange& range) {
        return range.first_rank >= 0 && range.count >= 1;
    };
    const auto num_parts = static_cast<std::size_t>(map.num_parts);
    return map.num_ranks >= 1 && (map.is_even || !map.listed.empty()) &&
           (!map.one_each || map.num_parts == map.num_ranks) &&
           (map.listed.empty() || map.listed.size() == num_parts) &&
           std::ranges::all_of(map.listed, valid_range);
}

LastPartition make_last(Cuts&& cuts, PartMap&& map, std::vector<Part>&& numbers) {
    const auto num_parts = static_cast<std::size_t>(map.num_parts);
    if (!is_consistent(map) || !(numbers.empty() || numbers.size() == num_parts) ||
        !is_permutation(numbers))
        refuse("inconsistent");
    LastPartition last(num_parts);
    std::vector<Part> room(numbers.size());
    last.keep(std::move(cuts), std::move(map), Numbering(std::move(numbers), std::move(room)));
    last.answer_look_ups(true);
    return last;
}

/// Writes or reads a partition, or that there is none.
void store(SavedState& saved, std::optional<LastPartition>& last) {
    bool has_cuts = last.has_value();
    saved.each(has_cuts);
    if (!has_cuts) return;
    std::vector<std::byte> cuts = last ? save(last->cuts()) : std::vector<std::byte>();
    PartMap map = last ? last->map() : PartMap{};
    std::vector<Part> numbers = last ? last->numbering().numbers() : std::vector<Part>();
    store_bytes(saved, cuts);
    saved.each(map.num_ranks, map.one_each, map.is_even);
    store_list(saved, map.listed,
               [&](RankRange& range) { saved.each(range.first_rank, range.count); });
    store_list(saved, numbers, [&](Part& number) { saved.each(number); });
    if (last) return;
    Cuts loaded = load<Cuts>(cuts);
    map.num_parts = loaded.num_parts;
    last = make_last(std::move(loaded), std::move(map), std::move(numbers));
}

/// Writes or reads a parcel.
void store(SavedState& saved, Parcel& parcel) {
    store_list(saved, parcel.given.entries, [&](auto& entry) {
        store_bytes(saved, entry.first);
        store_bytes(saved, entry.second);
    });
    store_list(saved, parcel.part_sizes, [&](PartSize& entry) {
        auto size = static_cast<double>(entry.size);
        saved.each(entry.part, entry.global, size, entry.weight);
        entry.size = static_cast<float>(size);
    });
    store_bytes(saved, parcel.of_zoltan);
    store(saved, parcel.last);
}

}  // namespace

std::vector<char> serialize(const State& state, const std::vector<char>& of_zoltan) {
    Parcel parcel{state.parameters.given, state.part_sizes, std::nullopt, of_zoltan};
    if (state.last && state.last->answers_look_ups()) parcel.last = state.last->copy();
    SavedState saved(StateKind::zoltan_handle);
    store(saved, parcel);
    const std::vector<std::byte> body = saved.bytes();
    const Header header{signature, body.size()};
    std::vector<char> bytes(sizeof header + body.size());
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, body.data(), body.size());
    return bytes;
}

bool is_parcel(std::span<const char> bytes) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin());
}

Parcel deserialize(std::span<const char> bytes) {
    Header header;
    if (bytes.size() < sizeof header) refuse("truncated");
    std::memcpy(&header, bytes.data(), sizeof header);
    const auto body = std::as_bytes(bytes.subspan(sizeof header));
    if (header.size > body.size()) {
        const bool swapped = __builtin_bswap64(header.size) <= body.size();
        refuse(swapped ? "from a machine with the other byte order" : "truncated");
    }
    try {
        SavedState saved(body.first(header.size), StateKind::zoltan_handle);
        Parcel parcel;
        store(saved, parcel);
        return parcel;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::out_of_memory) throw std::bad_alloc();
        refuse("damaged");
    }
}

}  // namespace rrcb::zoltan
