#include "zoltan/call/lists_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <cstring>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// An object on its way: words of its global id, of its local id, and its part.
template <class Widths>
struct Record {
    Widths widths;

    std::size_t bytes() const {
        return (widths.global + widths.local) * sizeof(IdWord) + sizeof(int);
    }

    void write(const List& list, std::size_t i, std::byte* place) const {
        place = put(list.global_ids.get(), widths.global, i, place);
        place = put(list.local_ids.get(), widths.local, i, place);
        put(list.parts.get(), 1, i, place);
    }

    void read(const std::byte* place, std::size_t i, List& list) const {
        place = get(place, widths.global, i, list.global_ids.get());
        place = get(place, widths.local, i, list.local_ids.get());
        get(place, 1, i, list.parts.get());
    }

  private:
    // Copied word by word: widths are small, and known at run time only.
    template <typename T>
    static std::byte* put(const T* array, std::size_t width, std::size_t i, std::byte* place) {
        for (std::size_t word = 0; word < width; ++word, place += sizeof(T))
            std::memcpy(place, &array[i * width + word], sizeof(T));
        return place;
    }

    template <typename T>
    static const std::byte* get(const std::byte* place, std::size_t width, std::size_t i,
                                T* array) {
        for (std::size_t word = 0; word < width; ++word, place += sizeof(T))
            std::memcpy(&array[i * width + word], place, sizeof(T));
        return place;
    }
};

List make_list(std::size_t count, const IdWidths& widths) {
    List list;
    list.count = mpi::to_int(static_cast<std::int64_t>(count));
    list.global_ids = ZoltanArray<IdWord>(count * widths.global);
    list.local_ids = ZoltanArray<IdWord>(count * widths.local);
    list.ranks = ZoltanArray<int>(count);
    list.parts = ZoltanArray<int>(count);
    return list;
}

/// Import list that answers the export lists of all ranks. Collective.
List invert(const List& exports, const Parameters& parameters, ExchangeBuffers& memory,
            Participant& self) {
    const IdWidths widths(parameters);
    Exchange exchange(Record{widths}.bytes(), mpi::size_of(self.comm), std::move(memory));
    self.attempt([&] {
        const std::span ranks(exports.ranks.get(), static_cast<std::size_t>(exports.count));
        visit_widths(widths, [&](const auto& known) {
            exchange.fill(ranks, [&](std::size_t i, std::byte* place) {
                Record{known}.write(exports, i, place);
            });
        });
    });
    const std::size_t count = exchange.announce(self);
    List imports;
    self.attempt([&] { imports = make_list(count, widths); });
    agree(self);
    exchange.run(self);
    visit_widths(widths, [&](const auto& known) {
        exchange.for_each([&, i = std::size_t{0}](int source, const std::byte* place) mutable {
            imports.ranks[i] = source;
            Record{known}.read(place, i++, imports);
        });
    });
    memory = exchange.take_memory();
    return imports;
}

}  // namespace

void select_lists(const Parameters& parameters, bool changes, ExchangeBuffers& memory,
                  Participant& self, List& imports, List& exports) {
    constexpr int not_asked = -1;
    const ReturnLists asked = parameters.return_lists;
    if (!changes) return;
    if (asked == ReturnLists::all || asked == ReturnLists::imports) {
        imports = invert(exports, parameters, memory, self);
    } else {
        imports.count = not_asked;
    }
    if (asked == ReturnLists::imports || asked == ReturnLists::none) {
        exports = List{};
        exports.count = not_asked;
    }
}

}  // namespace rrcb::zoltan
