#include "zoltan/call/lists_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <cstring>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Objects as they are sent: the words of a global id, of a local id, and a part. The members are
/// copies, so that the compiler can assume that writes do not change them.
template <class Widths>
struct Records {
    Records(const Widths& words, const List& list)
        : widths(words),
          global_ids(list.global_ids.get()),
          local_ids(list.local_ids.get()),
          parts(list.parts.get()) {}

    void write(std::size_t i, std::byte* place) const {
        place = put(global_ids + i * widths.global, widths.global, place);
        place = put(local_ids + i * widths.local, widths.local, place);
        std::memcpy(place, &parts[i], sizeof parts[i]);
    }

    void read(const std::byte* place, std::size_t i) const {
        place = get(place, widths.global, global_ids + i * widths.global);
        place = get(place, widths.local, local_ids + i * widths.local);
        std::memcpy(&parts[i], place, sizeof parts[i]);
    }

  private:
    // Copies word by word, because widths are small and known only at run time.
    static std::byte* put(const IdWord* words, std::size_t width, std::byte* place) {
        for (std::size_t word = 0; word < width; ++word, place += sizeof(IdWord))
            std::memcpy(place, &words[word], sizeof(IdWord));
        return place;
    }

    static const std::byte* get(const std::byte* place, std::size_t width, IdWord* words) {
        for (std::size_t word = 0; word < width; ++word, place += sizeof(IdWord))
            std::memcpy(&words[word], place, sizeof(IdWord));
        return place;
    }

    Widths widths;
    IdWord* global_ids;
    IdWord* local_ids;
    int* parts;
};

/// Returns the import list that corresponds to the export lists of all ranks. Collective.
List invert(const List& exports, const Parameters& parameters, ExchangeBuffers& memory,
            Participant& self) {
    const IdWidths widths(parameters);
    const std::size_t bytes = (widths.global + widths.local) * sizeof(IdWord) + sizeof(int);
    Exchange exchange(bytes, mpi::size_of(self.comm), std::move(memory));
    self.attempt([&] {
        const std::span ranks(exports.ranks.get(), static_cast<std::size_t>(exports.count));
        visit_widths(widths, [&](const auto& known) {
            exchange.fill(ranks, [records = Records(known, exports)](
                                     std::size_t i, std::byte* place) { records.write(i, place); });
        });
    });
    const std::size_t count = exchange.announce(self);
    List imports;
    self.attempt(
        [&] { imports = make_list(mpi::to_int(static_cast<std::int64_t>(count)), widths); });
    agree(self);
    exchange.run(self);
    visit_widths(widths, [&](const auto& known) {
        exchange.for_each([records = Records(known, imports), ranks = imports.ranks.get(),
                           i = std::size_t{0}](int source, const std::byte* place) mutable {
            ranks[i] = source;
            records.read(place, i++);
        });
    });
    memory = exchange.take_memory();
    return imports;
}

}  // namespace

Lists select_lists(const Parameters& parameters, const Moves& moves, bool changes,
                   ExchangeBuffers& memory, Participant& self) {
    constexpr int not_asked = -1;
    const ReturnLists asked = parameters.return_lists;
    const IdWidths widths(parameters);
    Lists lists;
    List& exports = lists.exports;
    if (asked == ReturnLists::parts) exports = moves.list_all();
    if (!changes) return lists;
    if (asked == ReturnLists::all || asked == ReturnLists::imports) {
        self.attempt([&] {
            exports = make_list(moves.count(), widths);
            moves.write(widths, exports);
        });
        lists.imports = invert(exports, parameters, memory, self);
    } else {
        lists.imports.count = not_asked;
    }
    if (asked == ReturnLists::exports) {
        exports = moves.take_room();
        moves.write(widths, exports);
    } else if (asked == ReturnLists::imports || asked == ReturnLists::none) {
        exports = List{};
        exports.count = not_asked;
    }
    return lists;
}

}  // namespace rrcb::zoltan
