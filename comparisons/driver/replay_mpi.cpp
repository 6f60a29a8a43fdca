#include "replay_mpi.hpp"

#include "dump.hpp"
#include "failure_mpi.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace comparisons {

namespace {

using rrcb::GlobalCount;

/// What rank 0 finds in the heads of all files of a dump.
struct Survey {
    int num_ranks = 0;
    int dimension = 0;
    int num_weights = 0;
    std::vector<GlobalCount> starts;  ///< first point of each rank, then the number of all
    std::string note;
};

std::string describe(const DumpedCall& call) {
    std::string text = "dump: " + call.function + " on " + std::to_string(call.num_ranks) +
                       " ranks, code " + std::to_string(call.code) + ", parameters:";
    for (const auto& [name, value] : call.parameters) text += ' ' + name + '=' + value;
    return text + '\n';
}

void note_rank(Survey& survey, const DumpedRank& dumped, int rank) {
    const std::string name = "rank " + std::to_string(rank);
    if (!dumped.message.empty()) survey.note += "dump: " + name + ": " + dumped.message + '\n';
    survey.starts.push_back(survey.starts.back() + static_cast<GlobalCount>(dumped.count));
    if (dumped.count == 0) return;
    const bool is_first = survey.dimension == 0;
    if (is_first) survey.dimension = dumped.dimension;
    if (is_first) survey.num_weights = dumped.num_weights;
    if (dumped.dimension == survey.dimension && dumped.num_weights == survey.num_weights) return;
    throw Failure("the dump's " + name +
                  " has another dimension or number of weights than those "
                  "before it; such calls cannot be replayed");
}

Survey survey_of(const std::string& folder) {
    const DumpedCall call = read_dumped_call(folder);
    Survey survey;
    survey.num_ranks = call.num_ranks;
    survey.starts = {0};
    survey.note = describe(call);
    for (int rank = 0; rank < call.num_ranks; ++rank)
        note_rank(survey, read_dumped_rank(folder, rank, false), rank);
    if (survey.starts.back() == 0) throw Failure(folder + ": the dump holds no points");
    if (survey.num_weights > 1) survey.note += "dump: only the first weight is balanced\n";
    return survey;
}

void broadcast(Survey& survey, MPI_Comm comm) {
    int numbers[] = {survey.num_ranks, survey.dimension, survey.num_weights,
                     static_cast<int>(survey.note.size())};
    MPI_Bcast(numbers, 4, MPI_INT, 0, comm);
    survey.num_ranks = numbers[0];
    survey.dimension = numbers[1];
    survey.num_weights = numbers[2];
    survey.note.resize(static_cast<std::size_t>(numbers[3]));
    survey.starts.resize(static_cast<std::size_t>(survey.num_ranks) + 1);
    MPI_Bcast(survey.note.data(), numbers[3], MPI_CHAR, 0, comm);
    MPI_Bcast(survey.starts.data(), survey.num_ranks + 1, MPI_INT64_T, 0, comm);
}

/// Points first ... last - 1 of the dump; whole files are read, pieces of them kept.
void read_points(const std::string& folder, const Survey& survey, GlobalCount first,
                 GlobalCount last, Workload& workload) {
    for (int r = 0; r < survey.num_ranks; ++r) {
        const GlobalCount start = survey.starts[static_cast<std::size_t>(r)];
        const GlobalCount from = std::max(first, start);
        const GlobalCount to = std::min(last, survey.starts[static_cast<std::size_t>(r) + 1]);
        if (from >= to) continue;
        const DumpedRank dumped = read_dumped_rank(folder, r, true);
        const auto append = [&](std::vector<double>& all, const std::vector<double>& part, int n) {
            all.insert(all.end(), part.begin() + (from - start) * n,
                       part.begin() + (to - start) * n);
        };
        append(workload.coordinates, dumped.coordinates, survey.dimension);
        if (workload.weighted) append(workload.weights, dumped.weights, 1);
    }
}

/// The last component, whatever follows it.
std::string name_of(const std::string& folder) {
    const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string note_of_faults(const Workload& workload, MPI_Comm comm) {
    const auto is_fault = [](double x) { return !std::isfinite(x); };
    GlobalCount faults = std::ranges::count_if(workload.coordinates, is_fault) +
                         std::ranges::count_if(workload.weights, is_fault);
    MPI_Allreduce(MPI_IN_PLACE, &faults, 1, MPI_INT64_T, MPI_SUM, comm);
    if (faults == 0) return {};
    return "dump: " + std::to_string(faults) +
           " coordinates or weights are not finite; Zoltan's own methods may never return\n";
}

}  // namespace

Replay read_replay(const std::string& folder, MPI_Comm comm) {
    const int rank = rank_of(comm);
    const int size = size_of(comm);
    Survey survey;
    on_root([&] { survey = survey_of(folder); }, comm);
    broadcast(survey, comm);

    const bool same_ranks = survey.num_ranks == size;
    const auto start_of = [&](int r) {
        return same_ranks ? survey.starts[static_cast<std::size_t>(r)]
                          : survey.starts.back() * r / size;
    };
    Replay replay;
    Workload& workload = replay.workload;
    workload.name = name_of(folder);
    workload.layout = same_ranks ? "dump" : "dealt";
    workload.dimension = survey.dimension;
    workload.weighted = survey.num_weights > 0;
    std::string message;
    try {
        read_points(folder, survey, start_of(rank), start_of(rank + 1), workload);
    } catch (const std::exception& error) {
        message = error.what();
    }
    fail_together(message, comm);

    replay.note = survey.note + note_of_faults(workload, comm);
    if (!same_ranks) {
        replay.note += "dump: of " + std::to_string(survey.num_ranks) +
                       " ranks, dealt out in order to " + std::to_string(size) + '\n';
    }
    return replay;
}

}  // namespace comparisons
