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

/// Returns text without line breaks, which would end its entry.
std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

void write_point(std::FILE* file, const DumpedRank& mine, LocalIndex i) {
    const Points& points = mine.points;
    for (int axis = 0; axis < points.dimension; ++axis)
        std::fprintf(file, "%a ", points.coordinate(i, axis));
    const auto num_weights = static_cast<std::size_t>(mine.weight_dimension);
    for (std::size_t w = 0; w < num_weights; ++w)
        std::fprintf(file, "%a ", static_cast<double>(mine.weights[i * num_weights + w]));
    if (mine.initial_parts != nullptr) std::fprintf(file, "%d", mine.initial_parts[i]);
    std::fputc('\n', file);
}

}  // namespace

std::filesystem::path make_dump_folder(const std::filesystem::path& parent) {
    std::filesystem::create_directories(parent);
    // Numbers to try first. A folder that exists is never taken.
    thread_local std::map<std::filesystem::path, int> numbers;
    while (true) {
        std::filesystem::path folder = parent / ("call-" + std::to_string(++numbers[parent]));
        if (std::filesystem::create_directory(folder)) return folder;
    }
}

void write_dump(const std::filesystem::path& folder, const DumpedCall& call) {
    const std::filesystem::path path = folder / "call.txt";
    File file = create(path);
    std::fprintf(file.get(), "rrcb-dump 1\nversion %s\nfunction %s\ncode %d\nranks %d\n",
                 rrcb::version(), call.function, call.code, call.num_ranks);
    for (const auto& [name, value] : call.parameters.given.entries)
        std::fprintf(file.get(), "parameter %s %s\n", name.c_str(), one_line(value).c_str());
    finish(std::move(file), path);
}

void write_dump(const std::filesystem::path& folder, const DumpedRank& mine) {
    const std::filesystem::path path = folder / ("rank-" + std::to_string(mine.rank) + ".txt");
    File file = create(path);
    std::fprintf(file.get(), "rrcb-dump-rank 1\nrank %d\n", mine.rank);
    if (*mine.message != '\0')
        std::fprintf(file.get(), "message %s\n", one_line(mine.message).c_str());
    for (const PartSize& size : mine.part_sizes)
        if (size.weight == 0)
            std::fprintf(file.get(), "part_size %s %d %a\n", size.global ? "global" : "local",
                         size.part, static_cast<double>(size.size));
    std::fprintf(file.get(), "dimension %d\nweights %d\nparts %d\nobjects %zu\n",
                 mine.points.dimension, mine.weight_dimension,
                 mine.initial_parts == nullptr ? 0 : 1, mine.points.count);
    for (LocalIndex i = 0; i < mine.points.count; ++i) write_point(file.get(), mine, i);
    finish(std::move(file), path);
}

}  // namespace rrcb::zoltan
