#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Number of a record's subject; records of one key have one owner.
using Key = std::uint64_t;

/// A key, the rank that owns it, and any number of doubles about it.
struct Record {
    Key key = 0;
    int owner = 0;
    std::span<const double> payload{};
};

/// Reads records one after the other from doubles.
class RecordReader {
  public:
    explicit RecordReader(std::span<const double> words) : words_(words) {}

    bool at_end() const { return words_.empty(); }

    /// Returns the doubles of all records that were not read.
    std::span<const double> words() const { return words_; }

    Record next() {
        const auto [owner, length] = std::bit_cast<Head>(words_[1]);
        const Record record{std::bit_cast<Key>(words_[0]), owner,
                            words_.subspan(head_length, length)};
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

/// Appends a record. Throws std::bad_alloc; then the record is not there.
inline void append_record(std::vector<double>& words, const Record& record) {
    const auto length = static_cast<std::uint32_t>(record.payload.size());
    const std::size_t needed = words.size() + RecordReader::head_length + length;
    if (words.capacity() < needed) words.reserve(std::max(needed, 2 * words.capacity()));
    words.push_back(std::bit_cast<double>(record.key));
    words.push_back(std::bit_cast<double>(RecordReader::Head{record.owner, length}));
    words.insert(words.end(), record.payload.begin(), record.payload.end());
}

/// Records, one after the other, and the range of ranks of their owners.
class Records {
  public:
    void clear() {
        words_.clear();
        forget_notes();
    }
    bool empty() const { return words_.empty(); }

    /// Returns true if the owners of all records are ranks from `begin` to before `end`.
    bool are_owned_between(int begin, int end) const {
        return begin <= lowest_owner_ && highest_owner_ < end;
    }

    /// Allocates memory for so many bytes of records. Throws std::bad_alloc.
    void reserve_bytes(std::size_t size) { words_.reserve(size / sizeof(double)); }

    /// Throws std::bad_alloc; then the record is not there.
    void append(const Record& record) {
        append_record(words_, record);
        note(record);
    }

    /// Appends a record with the key of two others, and the payload that join(a, b, joined) appends
    /// to `joined`. Throws std::bad_alloc; then all records here are void.
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
        RecordReader reader = read();
        forget_notes();
        auto end = words_.begin();
        // Before `end` are the records that stay, of those that were read.
        while (!reader.at_end()) {
            const double* begin = reader.words().data();
            const Record record = reader.next();
            if (!stay(record)) continue;
            note(record);
            end = std::copy(begin, reader.words().data(), end);
        }
        words_.erase(end, words_.end());
    }

    RecordReader read() const { return RecordReader(words_); }

    /// Calls visit(record) for each of them.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (RecordReader reader = read(); !reader.at_end();) visit(reader.next());
    }

    std::size_t size_bytes() const { return words_.size() * sizeof(double); }

  private:
    void note(const Record& record) {
        lowest_owner_ = std::min(lowest_owner_, record.owner);
        highest_owner_ = std::max(highest_owner_, record.owner);
    }

    void forget_notes() {
        lowest_owner_ = std::numeric_limits<int>::max();
        highest_owner_ = -1;
    }

    std::vector<double> words_;
    int lowest_owner_ = std::numeric_limits<int>::max();
    int highest_owner_ = -1;
};

}  // namespace rrcb
