#include "zoltan/handle/serialization.hpp"

#include "collective/failure.hpp"
#include "options/validation.hpp"
#include "zoltan/real/message.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace rrcb::zoltan {

namespace {

constexpr std::array<char, 8> signature = {'R', 'R', 'C', 'B', 'h', 'n', 'd', '6'};

struct Header {
    std::array<char, 8> signature = zoltan::signature;
    std::uint64_t size = 0;  ///< of the bytes that follow
    std::uint64_t checksum = 0;
};

[[noreturn]] void refuse(const char* why) {
    throw_fatal(std::string("the buffer of Zoltan_Serialize is ") + why);
}

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
std::uint64_t checksum_of(std::span<const char> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char byte : bytes) {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
    return hash;
}

class Writer {
  public:
    template <typename T>
    void value(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* bytes = reinterpret_cast<const char*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
    }
    void text(const std::string& text) {
        value<std::uint64_t>(text.size());
        bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    template <typename T>
    void list(const std::vector<T>& list) {
        value<std::uint64_t>(list.size());
        for (const T& entry : list) value(entry);
    }
    const std::vector<char>& bytes() const { return bytes_; }

  private:
    std::vector<char> bytes_;
};

class Reader {
  public:
    explicit Reader(std::span<const char> bytes) : bytes_(bytes) {}

    template <typename T>
    T value() {
        T result;
        std::memcpy(&result, take(sizeof(T)), sizeof(T));
        return result;
    }
    /// Reads a bool. A byte other than 0 and 1 must not become one.
    bool flag() {
        const auto byte = value<unsigned char>();
        if (byte > 1) refuse("inconsistent");
        return byte == 1;
    }
    std::string text() {
        const auto size = value<std::uint64_t>();
        return {take(size), size};
    }
    template <typename T>
    std::vector<T> list() {
        const auto size = value<std::uint64_t>();
        if (size > bytes_.size() / sizeof(T)) refuse("truncated");
        std::vector<T> result(size);
        for (T& entry : result) entry = value<T>();
        return result;
    }

  private:
    const char* take(std::uint64_t size) {
        if (size > bytes_.size()) refuse("truncated");
        const char* start = bytes_.data();
        bytes_ = bytes_.subspan(size);
        return start;
    }

    std::span<const char> bytes_;
};

void write(Writer& writer, const LastPartition& last) {
    writer.value(last.cuts().dimension);
    writer.value(last.cuts().shape.group_size);
    writer.value(last.cuts().shape.larger_below);
    writer.value(last.cuts().shape.dealt);
    writer.value<std::uint64_t>(last.cuts().tree.size());
    for (const Cut& cut : last.cuts().tree) {
        writer.value(cut.axis);
        writer.value(cut.divides);
        writer.value(cut.at);
    }
    writer.list(last.numbering().numbers());
    const PartMap& map = last.map();
    writer.value(map.num_parts);
    writer.value(map.num_ranks);
    writer.value(map.one_each);
    writer.value(map.is_even);
    writer.list(map.listed);
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
    return map.num_parts >= 1 && map.num_ranks >= 1 && (map.is_even || !map.listed.empty()) &&
           (!map.one_each || map.num_parts == map.num_ranks) &&
           (map.listed.empty() || map.listed.size() == num_parts) &&
           std::ranges::all_of(map.listed, valid_range);
}

bool is_consistent(const Cuts& cuts, const PartMap& map, const std::vector<Part>& numbers) {
    return is_consistent(map) && !attempt([&] { check_tree(cuts); }).failed &&
           (numbers.empty() || numbers.size() == cuts.tree.size() + 1) && is_permutation(numbers);
}

LastPartition read_last(Reader& reader) {
    Cuts cuts;
    cuts.dimension = reader.value<int>();
    cuts.shape.group_size = reader.value<int>();
    cuts.shape.larger_below = reader.flag();
    cuts.shape.dealt = reader.value<int>();
    for (auto left = reader.value<std::uint64_t>(); left > 0; --left) {
        const auto axis = reader.value<std::int32_t>();
        const auto divides = reader.value<std::int32_t>();
        cuts.tree.push_back({axis, divides, reader.value<Vector>()});
    }
    auto numbers = reader.list<Part>();
    PartMap map;
    map.num_parts = reader.value<int>();
    map.num_ranks = reader.value<int>();
    map.one_each = reader.flag();
    map.is_even = reader.flag();
    map.listed = reader.list<RankRange>();
    cuts.num_parts = map.num_parts;
    if (!is_consistent(cuts, map, numbers)) refuse("inconsistent");
    LastPartition last(static_cast<std::size_t>(map.num_parts));
    std::vector<Part> room(numbers.size());
    last.keep(std::move(cuts), std::move(map),
              Numbering::of_all(std::move(numbers), std::move(room)));
    last.answer_look_ups(true);
    return last;
}

}  // namespace

std::vector<char> serialize(const State& state, const std::vector<char>& of_zoltan) {
    Writer body;
    body.value<std::uint64_t>(state.parameters.given.size());
    for (const auto& [name, value] : state.parameters.given) {
        body.text(name);
        body.text(value);
    }
    body.value<std::uint64_t>(state.part_sizes.size());
    for (const PartSize& entry : state.part_sizes) {
        body.value(entry.part);
        body.value(entry.global);
        body.value(entry.size);
        body.value(entry.weight);
    }
    body.list(of_zoltan);
    const bool has_cuts = state.last && state.last->answers_look_ups();
    body.value(has_cuts);
    if (has_cuts) write(body, *state.last);

    const Header header{signature, body.bytes().size(), checksum_of(body.bytes())};
    std::vector<char> bytes(sizeof header + body.bytes().size());
    std::memcpy(bytes.data(), &header, sizeof header);
    std::ranges::copy(body.bytes(), bytes.data() + sizeof header);
    return bytes;
}

bool is_parcel(std::span<const char> bytes) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin());
}

Parcel deserialize(std::span<const char> bytes) {
    if (bytes.size() < sizeof(Header)) refuse("truncated");
    const auto header = Reader(bytes).value<Header>();
    const auto body = bytes.subspan(sizeof(Header));
    if (header.size > body.size()) {
        const bool swapped = __builtin_bswap64(header.size) <= body.size();
        refuse(swapped ? "from a machine with the other byte order" : "truncated");
    }
    if (checksum_of(body.first(header.size)) != header.checksum) refuse("damaged");
    Reader reader(body.first(header.size));
    Parcel parcel;
    for (auto left = reader.value<std::uint64_t>(); left > 0; --left) {
        const std::string name = reader.text();
        parcel.given.note(name, reader.text());
    }
    for (auto left = reader.value<std::uint64_t>(); left > 0; --left) {
        const auto part = reader.value<int>();
        const auto global = reader.flag();
        const auto size = reader.value<float>();
        parcel.part_sizes.push_back({part, global, size, reader.value<int>()});
    }
    parcel.of_zoltan = reader.list<char>();
    if (reader.flag()) parcel.last = read_last(reader);
    return parcel;
}

}  // namespace rrcb::zoltan
