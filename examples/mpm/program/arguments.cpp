#include "program/arguments.hpp"

#include "balancers/balancers_mpi.hpp"

#include <Teuchos_CommandLineProcessor.hpp>

#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

namespace {

/// Returns the number of an option, or `none` if the option is not given. Throws
/// std::invalid_argument if the text is not a number.
template <typename Number>
Number number(const std::string& option, const std::string& text, Number none, Number least) {
    if (text.empty()) return none;
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least) ||
        !std::isfinite(static_cast<double>(value)))
        throw std::invalid_argument("--" + option + ": '" + text +
                                    "' is not a number of at least " + std::to_string(least) +
                                    (option == "every" ? " or auto" : ""));
    return value;
}

/// Numbers are read as texts, because Teuchos would report a wrong number on rank 0 only.
const std::map<std::string, std::string> helps{
    {"scene", "scene file in YAML"},
    {"balancer", balancer_names()},
    {"every", "steps between two rebalances, or auto: when they pay"},
    {"cost", "what is divided evenly: count, the points, or learned, their time"},
    {"end-time", "simulated seconds, in place of the scene's"},
    {"cell-size", "m, in place of the scene's"},
    {"vtk-every", "steps between VTK files; 0: none"},
    {"every-time", "simulated seconds between outputs, in place of steps"},
    {"state-every", "steps between states to restart from; 0: none"},
    {"restart", "go on from a file that --state-every wrote"},
    {"out", "folder for history.csv and VTK files"}};

}  // namespace

std::optional<Arguments> read_arguments(int argc, char** argv) {
    std::map<std::string, std::string> texts{
        {"balancer", "rrcb"}, {"cost", "count"}, {"every", "auto"}, {"out", "out"}};
    Arguments arguments;
    Teuchos::CommandLineProcessor parser(false, true);
    parser.setDocString("Simulates a scene of material points.");
    for (const auto& [name, help] : helps)
        parser.setOption(name.c_str(), &texts[name], help.c_str());
    parser.setOption("list-kernels", "no-list-kernels", &arguments.list_kernels,
                     "print what a step does, owns and sends, and stop");
    const auto outcome = parser.parse(argc, argv);
    if (outcome == Teuchos::CommandLineProcessor::PARSE_HELP_PRINTED) return std::nullopt;
    if (outcome != Teuchos::CommandLineProcessor::PARSE_SUCCESSFUL)
        throw std::invalid_argument("an option is not known; --help lists them all");
    arguments.scene = texts["scene"];
    arguments.balancer = texts["balancer"];
    arguments.out = texts["out"];
    arguments.restart = texts["restart"];
    arguments.learns_cost = texts["cost"] == "learned";
    if (!arguments.learns_cost && texts["cost"] != "count")
        throw std::invalid_argument("--cost: '" + texts["cost"] + "' is not count or learned");
    make_balancer(arguments.balancer, {},
                  arguments.learns_cost ? PointWeights([] { return std::vector<double>(); })
                                        : PointWeights());
    if (arguments.scene.empty())
        throw std::invalid_argument("--scene=FILE is missing; examples/mpm/scenes has some");
    if (arguments.out.empty()) throw std::invalid_argument("--out: must name a folder");
    const auto steps = [&](const char* option, int none, int least) {
        return number(option, texts[option], none, least);
    };
    const auto positive = [&](const char* option) {
        return number(option, texts[option], 0.0, 1e-300);
    };
    if (texts["every"] != "auto") arguments.every = steps("every", 0, 1);
    arguments.vtk_every = steps("vtk-every", -1, 0);
    arguments.state_every = steps("state-every", 0, 0);
    arguments.every_time = positive("every-time");
    arguments.end_time = positive("end-time");
    arguments.cell_size = positive("cell-size");
    return arguments;
}
