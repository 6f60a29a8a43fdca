// The two kinds of files of a dump, divided by a line "=".
#include "dump.hpp"

#include "failure.hpp"
#include "fuzzing.hpp"

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

template <class Read>
void read_or_refuse(const std::string& folder, const Read& read) {
    try {
        read();
    } catch (const comparisons::Failure& failure) {
        rrcb::fuzz::expect(std::string_view(failure.what()).starts_with(folder),
                           "the place is named");
    }
}

void check(const comparisons::DumpedRank& dumped) {
    using rrcb::fuzz::expect;
    expect(dumped.coordinates.size() == dumped.count * static_cast<std::size_t>(dumped.dimension),
           "all coordinates");
    expect(dumped.weights.size() == (dumped.num_weights > 0 ? dumped.count : 0), "a weight each");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    const std::string_view text = rrcb::fuzz::text_of(data, size);
    const std::size_t middle = std::min(text.find("\n=\n"), text.size());
    std::ofstream(folder.path / "call.txt") << text.substr(0, middle) << '\n';
    std::ofstream(folder.path / "rank-0.txt") << text.substr(std::min(middle + 3, text.size()));
    const std::string name = folder.path.string();
    read_or_refuse(name, [&] { comparisons::read_dumped_call(name); });
    read_or_refuse(name, [&] { check(comparisons::read_dumped_rank(name, 0, true)); });
    return 0;
}
