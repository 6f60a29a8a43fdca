#include "zoltan/dump/dump_mpi.hpp"

#include "zoltan/real/message.hpp"

#include <array>
#include <atomic>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace rrcb::zoltan {

namespace {

/// Path in a message. Its length is fixed, so that no rank can run out of memory before the others
/// know.
using PathText = std::array<char, 4096>;

PathText choose_folder(const State& state, const DumpInput& input) {
    PathText text{};
    const std::filesystem::path folder = make_dump_folder(state.parameters.dump_folder);
    const std::string name = std::filesystem::absolute(folder).string();
    if (name.size() >= text.size()) throw std::length_error("the name of the folder is too long");
    write_call(folder, state, input);
    name.copy(text.data(), name.size());
    return text;
}

/// Runs a step whose failure must not affect the call. Warns about the first failure.
template <typename Step>
void warn_once_if_failing(const State& state, const char* function, Step step) {
    static std::atomic<bool> warned = false;
    try {
        step();
    } catch (const std::exception& error) {
        std::array<char, 512> text{};
        std::snprintf(text.data(), text.size(), "cannot write to RRCB_DUMP: %s", error.what());
        if (!warned.exchange(true))
            print_warning(state.communicator->rank(), function, text.data());
    }
}

}  // namespace

void dump(DumpReason reason, const DumpWish& wish, const State& state,
          const DumpInput& input) noexcept {
    const bool is_time = wish.always == (reason == DumpReason::asked);
    if (wish.rank < 0 || !is_time) return;
    const Communicator& comm = *state.communicator;
    PathText folder{};
    if (comm.rank() == wish.rank)
        warn_once_if_failing(state, input.function, [&] { folder = choose_folder(state, input); });
    const int sent =
        MPI_Bcast(folder.data(), static_cast<int>(folder.size()), MPI_CHAR, wish.rank, comm.get());
    if (sent != MPI_SUCCESS || folder[0] == '\0') return;
    warn_once_if_failing(state, input.function, [&] {
        // Ranks on other file systems have to make the folder, too.
        std::filesystem::create_directories(folder.data());
        write_rank(folder.data(), state, input);
    });
}

}  // namespace rrcb::zoltan
