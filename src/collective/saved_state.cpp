#include "collective/saved_state.hpp"

#include "options/rejection.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <cstring>
#include <string>

namespace rrcb {

namespace {

constexpr std::uint64_t magic = 0x5252434273746174;  // "RRCBstat"
constexpr std::uint64_t newest_format = 2;

/// Words of the head.
enum Head : std::size_t { mark, format, kind_of_state, num_words, checksum, head_size };

std::uint64_t reversed(std::uint64_t word) {
    std::uint64_t result = 0;
    for (int k = 0; k < 8; ++k) result = result << 8 | (word >> (8 * k) & 0xff);
    return result;
}

std::uint64_t checksum_of(std::span<const std::uint64_t> words) {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words.subspan(head_size)) sum = detail::mix(sum ^ word);
    return sum;
}

std::string name_of(StateKind kind) {
    switch (kind) {
        case StateKind::cuts:
            return "Cuts";
        case StateKind::controller:
            return "a Controller";
        case StateKind::cost_model:
            return "a CostModel";
        case StateKind::zoltan_handle:
            break;
    }
    return "a handle of Zoltan";
}

void check_head(std::span<const std::uint64_t> words, std::size_t num_bytes, StateKind kind) {
    require(words.size() >= head_size && words[mark] == magic,
            "the bytes are no state that save() of RRCB wrote; pass the bytes of save()");
    if (words[format] > newest_format)
        reject("the state was saved by a newer RRCB (format " + std::to_string(words[format]) +
               ", this one reads " + std::to_string(newest_format) +
               "); load it there, or begin anew");
    if (words[num_words] != words.size() || num_bytes != words.size() * sizeof(std::uint64_t))
        reject("the saved state has " + std::to_string(num_bytes) + " bytes, not " +
               std::to_string(words[num_words] * sizeof(std::uint64_t)) +
               "; pass all bytes of save()");
    require(words[checksum] == checksum_of(words),
            "the saved state was changed: its checksum is another; load another copy");
    if (words[kind_of_state] != static_cast<std::uint64_t>(kind))
        reject("the saved state is not of " + name_of(kind) + " but of " +
               name_of(static_cast<StateKind>(words[kind_of_state])) + "; load it as such");
}

}  // namespace

SavedState::SavedState(StateKind kind) : words_(head_size), next_(head_size), reads_(false) {
    words_[mark] = magic;
    words_[format] = newest_format;
    words_[kind_of_state] = static_cast<std::uint64_t>(kind);
}

SavedState::SavedState(std::span<const std::byte> bytes, StateKind kind)
    : words_(bytes.size() / sizeof(std::uint64_t)), next_(head_size), reads_(true) {
    if (!words_.empty())
        std::memcpy(words_.data(), bytes.data(), words_.size() * sizeof(std::uint64_t));
    if (!words_.empty() && words_[mark] == reversed(magic))
        std::ranges::transform(words_, words_.begin(), reversed);
    check_head(words_, bytes.size(), kind);
}

bool SavedState::has_format(std::uint64_t number) const {
    return words_[format] >= number;
}

void SavedState::exchange(std::uint64_t& word) {
    if (!reads_) {
        words_.push_back(word);
        return;
    }
    require(next_ < words_.size(), "the saved state is too short; pass all bytes of save()");
    word = words_[next_++];
}

void SavedState::require_count(std::uint64_t value, std::size_t most) {
    require(value <= most, "the saved state has an impossible count; load another copy");
}

std::vector<std::byte> SavedState::bytes() {
    words_[num_words] = words_.size();
    words_[checksum] = checksum_of(words_);
    const auto bytes = std::as_bytes(std::span(words_));
    return {bytes.begin(), bytes.end()};
}

}  // namespace rrcb
