#pragma once

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/exchange_mpi.hpp"

#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Sends the record make(k) to entry k of `ranks`. Calls reserve(number) before any record is
/// received, and then take(source, record) for each, in order of ranks. Collective.
template <class Record, class Make, class Reserve, class Take>
void exchange_records(std::span<const int> ranks, Make&& make, Reserve&& reserve, Take&& take,
                      std::initializer_list<Shared> arguments, Participant& self) {
    Exchange exchange(sizeof(Record), mpi::size_of(self.comm));
    self.attempt([&] {
        exchange.fill(ranks, [&](std::size_t k, std::byte* place) {
            const Record record = make(k);
            std::memcpy(place, &record, sizeof record);
        });
    });
    const std::size_t num_arrivals = exchange.announce(self);
    self.attempt([&] { reserve(num_arrivals); });
    agree(self, arguments);
    exchange.run(self);
    exchange.for_each([&](int source, const std::byte* place) {
        Record record;
        std::memcpy(&record, place, sizeof record);
        take(source, record);
    });
}

/// A received record and the rank that sent it.
template <class Record>
using Arrived = std::pair<int, Record>;

/// Records and the ranks to send them to.
template <class Record>
struct Outgoing {
    std::vector<int> ranks{};
    std::vector<Record> records{};

    void add(int rank, const Record& record) {
        ranks.push_back(rank);
        records.push_back(record);
    }

    /// Sends each record to its rank. Returns the received ones in order of ranks. Collective.
    std::vector<Arrived<Record>> send(Participant& self,
                                      std::initializer_list<Shared> arguments = {}) const {
        std::vector<Arrived<Record>> arrived;
        exchange_records<Record>(
            ranks, [&](std::size_t k) { return records[k]; },
            [&](std::size_t number) { arrived.reserve(number); },
            [&](int source, const Record& record) { arrived.emplace_back(source, record); },
            arguments, self);
        return arrived;
    }
};

}  // namespace rrcb
