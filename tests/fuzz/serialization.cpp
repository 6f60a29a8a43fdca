// The buffer of Zoltan_Serialize: read, or refused; what is read can be looked up in and written.
//
// The first byte decides: odd, and the rest is the buffer; even, and it is given a head that fits.
#include "zoltan/handle/serialization.hpp"

#include "collective/saved_state.hpp"
#include "fuzzing.hpp"
#include "zoltan/real/message.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using rrcb::fuzz::expect;

/// Returns a buffer of the words in `body`, which are not checked further.
std::vector<char> with_head(std::span<const char> body) {
    rrcb::SavedState saved(rrcb::StateKind::zoltan_handle);
    for (std::size_t i = 0; i + 8 <= body.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, body.data() + i, sizeof word);
        saved.each(word);
    }
    const std::vector<std::byte> state = saved.bytes();
    const std::uint64_t size = state.size();
    std::vector<char> bytes(16 + state.size());
    std::memcpy(bytes.data(), "RRCBhnd7", 8);
    std::memcpy(bytes.data() + 8, &size, 8);
    std::memcpy(bytes.data() + 16, state.data(), state.size());
    return bytes;
}

void look_up(const rrcb::zoltan::LastPartition& last) {
    const int num_parts = last.cuts().num_parts;
    std::vector<rrcb::Part> touched(static_cast<std::size_t>(num_parts));
    for (const double x : {-1e300, 0.0, 0.5, 3.0}) {
        const rrcb::Vector position{x, -x, x / 2};
        const rrcb::Part part = last.part_of(position.data());
        expect(part >= 0 && part < num_parts, "parts that there are");
        const int count = last.parts_touching({position, position}, touched.data());
        expect(count == 1 && touched[0] == part, "one part touches a position");
    }
    for (rrcb::Part part = 0; part < num_parts; ++part) last.region_of(part);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const char> rest(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::vector<char> bytes =
        data[0] % 2 == 1 ? std::vector<char>(rest.begin(), rest.end()) : with_head(rest);
    try {
        rrcb::zoltan::Parcel parcel = rrcb::zoltan::deserialize(bytes);
        if (parcel.last) look_up(*parcel.last);
        rrcb::zoltan::State state;
        state.parameters.given = parcel.given;
        state.part_sizes = parcel.part_sizes;
        state.last = std::move(parcel.last);
        const std::vector<char> again = rrcb::zoltan::serialize(state, parcel.of_zoltan);
        expect(rrcb::zoltan::serialize(state, parcel.of_zoltan) == again, "the same bytes twice");
        expect(rrcb::zoltan::deserialize(again).given.entries == parcel.given.entries,
               "the same parameters");
    } catch (const rrcb::zoltan::ZoltanError&) {
    }
    return 0;
}
