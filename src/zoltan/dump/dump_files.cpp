#include "zoltan/dump/dump_files.hpp"

#include <rrcb/version.hpp>

#include <cerrno>
#include <cstdio>
#include <map>
#include <memory>
#include <system_error>

namespace rrcb::zoltan {

namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const std::filesystem::path& path) {
    throw std::system_error(errno, std::generic_category(), path.string());
}

File create(const std::filesystem::path& path) {
    File file(std::fopen(path.c_str(), "w"));
    if (!file) fail(path);
    return file;
}

void finish(File file, const std::filesystem::path& path) {
    if (std::fputs("end\n", file.get()) < 0 || std::fclose(file.release()) != 0) fail(path);
}

/// Returns the text without line breaks, because a line break ends an entry.
std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

void write_point(std::FILE* file, const State& state, const DumpInput& input, LocalIndex i) {
    for (int axis = 0; axis < input.points.dimension; ++axis)
        std::fprintf(file, "%a ", input.points.coordinate(i, axis));
    // Weights are in the form in which the callbacks return them: all weights of an object
    // together.
    const float* const weights = state.workspace.callback_weights.data();
    const auto num_weights = static_cast<std::size_t>(state.parameters.weight_dimension);
    for (std::size_t w = 0; w < num_weights; ++w)
        std::fprintf(file, "%a ", static_cast<double>(weights[i * num_weights + w]));
    if (input.initial_parts != nullptr) std::fprintf(file, "%d", input.initial_parts[i]);
    std::fputc('\n', file);
}

}  // namespace

std::filesystem::path make_dump_folder(const std::filesystem::path& parent) {
    std::filesystem::create_directories(parent);
    // Number to try next in each folder. An existing folder is never used.
    thread_local std::map<std::filesystem::path, int> numbers;
    while (true) {
        std::filesystem::path folder = parent / ("call-" + std::to_string(++numbers[parent]));
        if (std::filesystem::create_directory(folder)) return folder;
    }
}

void write_call(const std::filesystem::path& folder, const State& state, const DumpInput& input) {
    const std::filesystem::path path = folder / "call.txt";
    File file = create(path);
    std::fprintf(file.get(), "rrcb-dump 1\nversion %s\nfunction %s\ncode %d\nranks %d\n",
                 rrcb::version(), input.function, input.code, state.communicator->size());
    for (const auto& [name, value] : state.parameters.given.entries)
        std::fprintf(file.get(), "parameter %s %s\n", name.c_str(), one_line(value).c_str());
    finish(std::move(file), path);
}

void write_rank(const std::filesystem::path& folder, const State& state, const DumpInput& input) {
    const int rank = state.communicator->rank();
    const std::filesystem::path path = folder / ("rank-" + std::to_string(rank) + ".txt");
    File file = create(path);
    std::fprintf(file.get(), "rrcb-dump-rank 1\nrank %d\n", rank);
    if (*input.message != '\0')
        std::fprintf(file.get(), "message %s\n", one_line(input.message).c_str());
    for (const PartSize& size : state.part_sizes)
        if (size.weight == 0)
            std::fprintf(file.get(), "part_size %s %d %a\n", size.global ? "global" : "local",
                         size.part, static_cast<double>(size.size));
    std::fprintf(file.get(), "dimension %d\nweights %d\nparts %d\nobjects %zu\n",
                 input.points.dimension, state.parameters.weight_dimension,
                 input.initial_parts == nullptr ? 0 : 1, input.points.count);
    for (LocalIndex i = 0; i < input.points.count; ++i) write_point(file.get(), state, input, i);
    finish(std::move(file), path);
}

}  // namespace rrcb::zoltan
