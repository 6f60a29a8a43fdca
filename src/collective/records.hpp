#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Number of what a record is about; those of one key have one owner.
using Key = std::uint64_t;

/// A key, the rank that owns it, and any number of doubles about it.
struct Record {
    Key key = 0;
    int owner = 0;
    std::span<const double> payload{};
};

/// Reads one record after the other from the doubles that hold them.
class RecordReader {
  public:
    explicit RecordReader(std::span<const double> words) : words_(words) {}

    bool at_end() const { return words_.empty(); }

    Record next() {
        const auto [owner, length] = std::bit_cast<Head>(words_[1]);
        const Record record{std::bit_cast<Key>(words_[0]), owner,
                            words_.subspan(head_length, length)};
        words_ = words_.subspan(head_length + length);
        return record;
    }

  private:
    friend void append_record(std::vector<double>& words, const Record& record);

    /// What follows the key.
    struct Head {
        std::int32_t owner;
        std::uint32_t length;
    };
    static constexpr std::size_t head_length = 2;

    std::span<const double> words_;
};

/// Puts a record behind others. Throws std::bad_alloc; then the record is not there.
inline void append_record(std::vector<double>& words, const Record& record) {
    const auto length = static_cast<std::uint32_t>(record.payload.size());
    const std::size_t needed = words.size() + RecordReader::head_length + length;
    if (words.capacity() < needed) words.reserve(std::max(needed, 2 * words.capacity()));
    words.push_back(std::bit_cast<double>(record.key));
    words.push_back(std::bit_cast<double>(RecordReader::Head{record.owner, length}));
    words.insert(words.end(), record.payload.begin(), record.payload.end());
}

/// Records, one after the other.
class Records {
  public:
    void clear() { words_.clear(); }
    bool empty() const { return words_.empty(); }

    /// Throws std::bad_alloc; then the record is not there.
    void append(const Record& record) { append_record(words_, record); }

    RecordReader read() const { return RecordReader(words_); }

    /// Calls visit(record) for each of them.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (RecordReader reader = read(); !reader.at_end();) visit(reader.next());
    }

    std::size_t size_bytes() const { return words_.size() * sizeof(double); }

  private:
    std::vector<double> words_;
};

}  // namespace rrcb
