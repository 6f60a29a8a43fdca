#include "arguments.hpp"

#include "cloud.hpp"
#include "failure.hpp"
#include "scene_choice_mpi.hpp"
#include "text.hpp"

#include <Teuchos_CommandLineProcessor.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace comparisons {

namespace {

/// The texts of the given options. The numbers are parsed here, because Teuchos accepts 5x as 5.
struct Texts {
    std::map<std::string, std::string> values;

    const std::string& operator[](const std::string& name) const { return values.at(name); }
    bool given(const std::string& name) const { return !values.at(name).empty(); }
};

const std::map<std::string, std::string>& documentation() {
    static const std::map<std::string, std::string> texts = {
        {"ranks", "ranks the program was started with"},
        {"scene",
         "simulation to run: slope (default) or another of " + scene_names() + ", or a scene file"},
        {"cloud", "generated points: " + cloud_names()},
        {"points", "points of the cloud; 1000000"},
        {"dim", "dimension of the cloud: 2 (default) or 3"},
        {"layout", "distribution of the points over the ranks: sorted (default) or scattered"},
        {"file", "CSV file of points: x,y[,z][,weight]"},
        {"replay", "folder of a dump of the plug-in's (RRCB_DUMP)"},
        {"methods", "methods, by commas, parameters in brackets, or all: " + method_names()},
        {"lists", "lists Zoltan returns: PARTS (default), EXPORT or ALL"},
        {"steps", "steps of the simulation; to the end of the scene"},
        {"from", "steps of the scene before the simulations begin, all from one state; 0"},
        {"every",
         "steps between rebalances, or auto (default): when they pay; or several by commas"},
        {"record", "steps between the records of a simulation in history.csv"},
        {"cost", "learned: simulations compare learned costs of points with counting; count"},
        {"repeats", "timed calls of each method; 6"},
        {"seed", "of the cloud and the order of turns; 1"},
        {"radius", "cut-off of the counted ghosts; twice the median distance to the nearest point"},
        {"ranks-per-node", "ranks on each machine, to count ghosts between machines"},
        {"only", "of a scene: calls on its snapshots or simulations; both"},
        {"out", "folder of the results; comparisons/out"},
    };
    return texts;
}

/// Reads the options without a value, and the texts of the others. Teuchos prints the help and
/// error messages on rank 0 only, so all ranks must use the code that it returns.
void parse(int argc, char** argv, Texts& texts, Arguments& arguments) {
    Teuchos::CommandLineProcessor processor(false);
    processor.setDocString("Compares RRCB with Zoltan's partitioners on the same points.\n");
    for (const auto& [name, text] : documentation()) {
        processor.setOption(name.c_str(), &texts.values[name], text.c_str());
    }
    processor.setOption("quick", "no-quick", &arguments.quick, "a small run of everything");
    processor.setOption("data", "no-data", &arguments.data, "write the data of the pictures");
    processor.setOption("serial", "no-serial", &arguments.serial,
                        "simulate on rank 0 alone as well, in turns with the others");
    processor.setOption("progress", "no-progress", &arguments.progress, "show how much is done");
    std::ostringstream output;
    const auto result = processor.parse(argc, argv, &output);
    if (result == Teuchos::CommandLineProcessor::PARSE_HELP_PRINTED) {
        arguments.help = output.str();
    } else if (result != Teuchos::CommandLineProcessor::PARSE_SUCCESSFUL) {
        const std::string text = output.str();
        const std::size_t error = std::min(text.find("Error,"), text.size());
        throw Failure(std::string(trim(std::string_view(text).substr(error))));
    }
}

/// Throws if an option has no value: Teuchos would treat it as not given.
void check_values(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        for (const auto& [name, text] : documentation()) {
            if (argument == "--" + name || argument == "--" + name + "=") {
                throw Failure("--" + name + " needs a value: --" + name + "=...; " + text);
            }
        }
    }
}

template <typename Number>
void read_integer(const Texts& texts, const std::string& name, Number& value, Number minimum,
                  Number maximum) {
    if (!texts.given(name)) return;
    const std::optional<Number> number = read_number<Number>(texts[name]);
    if (!number || *number < minimum || *number > maximum) {
        throw Failure("--" + name + " must be an integer from " + std::to_string(minimum) + " to " +
                      std::to_string(maximum) + ", not '" + texts[name] + "'");
    }
    value = *number;
}

template <typename Value>
void read_choice(const Texts& texts, const std::string& name, Value& value,
                 const std::vector<std::pair<std::string, Value>>& choices) {
    if (!texts.given(name)) return;
    const auto found = std::ranges::find(choices, texts[name], [](auto& c) { return c.first; });
    if (found == choices.end()) {
        throw Failure("--" + name + ": unknown value '" + texts[name] +
                      "'; choose from: " + joined(choices, &std::pair<std::string, Value>::first));
    }
    value = found->second;
}

void check_combination(const Texts& texts) {
    const int sources =
        texts.given("scene") + texts.given("cloud") + texts.given("file") + texts.given("replay");
    if (sources > 1) throw Failure("give one of --scene, --cloud, --file and --replay only");
    const auto needs = [&](const std::string& option, bool fits, const std::string& what) {
        if (texts.given(option) && !fits) throw Failure("--" + option + " goes with " + what);
    };
    const bool is_scene = sources == 0 || texts.given("scene");
    for (const char* option : {"points", "dim"})
        needs(option, texts.given("cloud"), "--cloud only; remove it");
    needs("layout", texts.given("cloud") || texts.given("file"),
          "--cloud or --file only; remove it");
    for (const char* option : {"only", "steps", "from", "every", "record", "cost"})
        needs(option, is_scene, "--scene only; remove it");
}

/// Returns the intervals of a list; "auto" becomes 0.
std::vector<int> read_intervals(const std::string& text) {
    std::vector<int> intervals;
    for (const std::string_view piece : split(text, ',')) {
        const std::optional<int> steps = piece == "auto" ? 0 : read_number<int>(piece);
        if (!steps || (*steps < 1 && piece != "auto"))
            throw Failure(
                "--every must be auto or an integer from 1 on, or several by commas, "
                "not '" +
                text + "'");
        intervals.push_back(*steps);
    }
    return intervals;
}

/// Returns the methods of a list. An empty list means that the scene runs without rebalancing only.
std::vector<Method> choose_methods(const std::string& text) {
    if (text == "all") return all_methods();
    if (text == "none") return {};
    return text.empty() ? default_methods() : read_methods(text);
}

void check_cloud(const std::string& name) {
    if (!name.empty()) cloud_points({.name = name, .num_points = 0, .dimension = 2}, 0, 0);
}

}  // namespace

Arguments read_arguments(int argc, char** argv) {
    Arguments arguments;
    Texts texts;
    check_values(argc, argv);
    parse(argc, argv, texts, arguments);
    if (arguments.help) return arguments;
    check_combination(texts);
    if (arguments.quick) arguments.points = 20'000;
    if (arguments.quick) arguments.repeats = 2;

    constexpr int many = std::numeric_limits<int>::max();
    if (texts.given("scene")) arguments.scene = texts["scene"];
    check_scene(arguments.scene);
    arguments.cloud = texts["cloud"];
    arguments.file = texts["file"];
    arguments.replay = texts["replay"];
    check_cloud(arguments.cloud);
    read_integer(texts, "ranks", arguments.ranks, 1, many);
    read_integer<rrcb::GlobalCount>(texts, "points", arguments.points, 1, 2'000'000'000);
    read_integer(texts, "dim", arguments.dimension, 2, 3);
    read_choice<Layout>(texts, "layout", arguments.layout,
                        {{"sorted", Layout::sorted}, {"scattered", Layout::scattered}});
    arguments.methods = choose_methods(texts["methods"]);
    read_choice<Lists>(texts, "lists", arguments.lists,
                       {{"PARTS", Lists::parts}, {"EXPORT", Lists::exports}, {"ALL", Lists::all}});
    read_integer(texts, "steps", arguments.steps, 1, many);
    read_integer(texts, "from", arguments.from, 0, many);
    read_integer(texts, "record", arguments.record_every, 1, many);
    if (texts.given("every")) arguments.every = read_intervals(texts["every"]);
    read_choice<Cost>(texts, "cost", arguments.cost,
                      {{"count", Cost::count}, {"learned", Cost::learned}});
    read_integer(texts, "repeats", arguments.repeats, 1, 1000);
    read_integer<std::uint64_t>(texts, "seed", arguments.seed, 0,
                                std::numeric_limits<std::uint64_t>::max());
    if (texts.given("radius")) {
        arguments.ghosts.radius = read_number<double>(texts["radius"]);
        if (!arguments.ghosts.radius ||
            !(*arguments.ghosts.radius > 0 && std::isfinite(*arguments.ghosts.radius)))
            throw Failure("--radius must be a number above 0, not '" + texts["radius"] + "'");
    }
    if (texts.given("ranks-per-node"))
        read_integer(texts, "ranks-per-node", arguments.ghosts.ranks_per_node.emplace(), 1, many);
    if (texts.given("out")) arguments.out = texts["out"];
    read_choice<Only>(texts, "only", arguments.only,
                      {{"calls", Only::calls}, {"simulations", Only::simulations}});
    return arguments;
}

}  // namespace comparisons
