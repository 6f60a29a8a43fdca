#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Number of the subject of a record. All records with one key have the same owner.
using Key = std::uint64_t;

/// A key, the rank that owns it, and any number of doubles as payload.
struct Record {
    Key key = 0;
    int owner = 0;
    std::span<const double> payload{};
};

/// Reads records one after the other from an array of doubles.
class RecordReader {
  public:
    explicit RecordReader(std::span<const double> words) : words_(words) {}

    bool at_end() const { return words_.empty(); }

    /// Returns the doubles of all records that have not been read.
    std::span<const double> words() const { return words_; }

    /// Returns the key of the next record.
    Key key() const { return std::bit_cast<Key>(words_[0]); }

    Record next() {
        const auto [owner, length] = std::bit_cast<Head>(words_[1]);
        const Record record{key(), owner, words_.subspan(head_length, length)};
        words_ = words_.subspan(head_length + length);
        return record;
    }

  private:
    friend class Records;
    friend void append_record(std::vector<double>& words, const Record& record);

    /// Head of a record, after its key.
    struct Head {
        std::int32_t owner;
        std::uint32_t length;
    };
    static constexpr std::size_t head_length = 2;

    std::span<const double> words_;
};

/// Appends a record. If it throws std::bad_alloc, the records are unchanged.
inline void append_record(std::vector<double>& words, const Record& record) {
    const auto length = static_cast<std::uint32_t>(record.payload.size());
    const std::size_t needed = words.size() + RecordReader::head_length + length;
    if (words.capacity() < needed) words.reserve(std::max(needed, 2 * words.capacity()));
    words.push_back(std::bit_cast<double>(record.key));
    words.push_back(std::bit_cast<double>(RecordReader::Head{record.owner, length}));
    words.insert(words.end(), record.payload.begin(), record.payload.end());
}

/// Records stored one after the other.
class Records {
  public:
    void clear() { words_.clear(); }
    bool empty() const { return words_.empty(); }

    /// Allocates memory for records of this many bytes. Throws std::bad_alloc.
    void reserve_bytes(std::size_t size) { words_.reserve(size / sizeof(double)); }

    /// Appends a record. If it throws std::bad_alloc, the records are unchanged.
    void append(const Record& record) { append_record(words_, record); }

    /// Appends a record with the common key of two others. join(a, b, joined) appends its payload
    /// to `joined`. If it throws std::bad_alloc, none of the records here is valid any more.
    template <class Join>
    void append_joined(const Record& a, const Record& b, Join&& join) {
        append({a.key, a.owner, {}});
        const std::size_t begin = words_.size();
        join(a.payload, b.payload, words_);
        const RecordReader::Head head{a.owner, static_cast<std::uint32_t>(words_.size() - begin)};
        words_[begin - 1] = std::bit_cast<double>(head);
    }

    /// Removes the records for which stay(record) is false.
    template <class Stay>
    void keep(Stay&& stay) {
        auto end = words_.begin();
        // Invariant: the records before `end` are those that were read and are kept.
        for (RecordReader reader = read(); !reader.at_end();) {
            const double* begin = reader.words().data();
            if (stay(reader.next())) end = std::copy(begin, reader.words().data(), end);
        }
        words_.erase(end, words_.end());
    }

    RecordReader read() const { return RecordReader(words_); }

    /// Calls visit(record) for each of them.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (RecordReader reader = read(); !reader.at_end();) visit(reader.next());
    }

  private:
    std::vector<double> words_;
};

}  // namespace rrcb
