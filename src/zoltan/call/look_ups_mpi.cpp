#include "zoltan/call/look_ups_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <utility>
#include <vector>

namespace rrcb::zoltan {

Numbering whole_numbering(const Numbering& numbering, const PartMap& map, Participant& self) {
    std::vector<Part> numbers;
    std::vector<Part> buffer;
    self.attempt([&] {
        numbers.resize(map.num_parts);
        buffer.resize(numbers.size());
    });
    agree(self);
    const auto [first, end] = map.parts_on(mpi::rank_of(self.comm));
    for (Part part = first; part < end; ++part) numbers[part] = numbering.number_of(part);
    mpi::check(
        MPI_Allreduce(MPI_IN_PLACE, numbers.data(), map.num_parts, MPI_INT, MPI_SUM, self.comm),
        "MPI_Allreduce");
    return Numbering::of_all(std::move(numbers), std::move(buffer));
}

}  // namespace rrcb::zoltan
