#include "collective/saved_state_mpi.hpp"

#include "collective/agreement_mpi.hpp"

#include <rrcb/detail/mix.hpp>

namespace rrcb {

std::vector<std::byte> save_together(StateKind kind, const std::array<double, 3>& mine,
                                     const std::function<void()>& wait,
                                     const std::function<void(SavedState&)>& write,
                                     Participant& self) {
    const auto length = static_cast<int>(mine.size());
    std::vector<double> of_ranks;
    self.attempt(
        [&] { of_ranks.resize(mine.size() * static_cast<std::size_t>(mpi::size_of(self.comm))); });
    agree(self, {{"the kind of the saved object", static_cast<std::uint64_t>(kind)}});
    wait();
    mpi::check(MPI_Allgather(mine.data(), length, MPI_DOUBLE, of_ranks.data(), length, MPI_DOUBLE,
                             self.comm),
               "MPI_Allgather");
    std::vector<std::byte> bytes;
    if (mpi::rank_of(self.comm) == root)
        self.attempt([&] {
            SavedState state(kind);
            write(state);
            state.each(of_ranks);
            bytes = state.bytes();
        });
    auto size = static_cast<std::uint64_t>(bytes.size());
    mpi::broadcast(std::as_writable_bytes(std::span(&size, 1)), root, self.comm);
    self.attempt([&] { bytes.resize(size); });
    agree(self);
    mpi::broadcast(bytes, root, self.comm);
    return bytes;
}

std::array<double, 3> numbers_of_rank(SavedState& state, int rank) {
    std::array<double, 3> numbers{};
    for (int k = 0; k <= rank; ++k) state.each(numbers);
    return numbers;
}

std::uint64_t hash_of_bytes(std::span<const std::byte> bytes) {
    std::uint64_t hash = bytes.size();
    for (const std::byte byte : bytes) hash = detail::mix(hash ^ static_cast<std::uint64_t>(byte));
    return hash;
}

}  // namespace rrcb
