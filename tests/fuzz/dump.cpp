// The two kinds of files of a dump, divided by a line "=".
#include "failure.hpp"
#include "fuzzing.hpp"
#include "points_files.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

/// A folder of this process, gone when it ends.
struct Folder {
    Folder()
        : path(std::filesystem::temp_directory_path() /
               ("rrcb-fuzz-dump-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
};

void check(const comparisons::Dump& dump) {
    using rrcb::fuzz::expect;
    const comparisons::Workload& workload = dump.workload;
    const std::size_t count = workload.points().count;
    expect(workload.coordinates.size() == count * static_cast<std::size_t>(workload.dimension),
           "all coordinates");
    expect(workload.weights.size() == (workload.weighted ? count : 0), "a weight each");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    const std::string_view text = rrcb::fuzz::text_of(data, size);
    const std::size_t middle = std::min(text.find("\n=\n"), text.size());
    std::ofstream(folder.path / "call.txt") << text.substr(0, middle) << '\n';
    std::ofstream(folder.path / "rank-0.txt") << text.substr(std::min(middle + 3, text.size()));
    const std::string name = folder.path.string();
    try {
        check(comparisons::read_dump(name));
    } catch (const comparisons::Failure& failure) {
        const std::string_view what = failure.what();
        rrcb::fuzz::expect(what.starts_with(name) || what.starts_with("the dump's rank"),
                           "the place is named");
    }
    return 0;
}
