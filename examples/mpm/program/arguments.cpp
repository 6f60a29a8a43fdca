#include "program/arguments.hpp"

#include "balancers/balancers_mpi.hpp"

#include <Teuchos_CommandLineProcessor.hpp>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace {

/// Number of an option, or `none` where it is not given. Throws std::invalid_argument for no
/// number.
template <typename Number>
Number number(const std::string& option, const std::string& text, Number none, Number least,
              const std::string& alternative = "") {
    if (text.empty()) return none;
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least) ||
        !std::isfinite(static_cast<double>(value)))
        throw std::invalid_argument("--" + option + ": '" + text +
                                    "' is not a number of at least " + std::to_string(least) +
                                    alternative);
    return value;
}

/// Numbers of options as texts: Teuchos would report a wrong one on rank 0 alone.
struct Texts {
    std::string every, cost = "count", load_every, vtk_every, every_time, state_every, end_time,
                       cell_size;
};

void set_options(Teuchos::CommandLineProcessor& parser, Arguments& arguments, Texts& texts) {
    parser.setDocString("Simulates a scene of material points.");
    parser.setOption("scene", &arguments.scene, "scene file, YAML or XML");
    parser.setOption("balancer", &arguments.balancer, balancer_names().c_str());
    parser.setOption("every", &texts.every, "steps between two rebalances, or auto: when they pay");
    parser.setOption("cost", &texts.cost,
                     "what is divided evenly: count, the points, or learned, their time");
    parser.setOption("load-every", &texts.load_every,
                     "steps between rows of loads.csv, the time of each rank; 0: none");
    parser.setOption("end-time", &texts.end_time, "simulated seconds, in place of the scene's");
    parser.setOption("cell-size", &texts.cell_size, "m, in place of the scene's");
    parser.setOption("vtk-every", &texts.vtk_every, "steps between VTK files; 0: none");
    parser.setOption("every-time", &texts.every_time,
                     "simulated seconds between rows of history.csv and probes.csv, and VTK files "
                     "where there are any, in place of steps");
    parser.setOption("state-every", &texts.state_every,
                     "steps between states to restart from; 0: none");
    parser.setOption("restart", &arguments.restart, "go on from a file that --state-every wrote");
    parser.setOption("out", &arguments.out, "folder for history.csv and VTK files");
    parser.setOption("list-kernels", "no-list-kernels", &arguments.list_kernels,
                     "tell what a step does, owns and sends, and stop");
}

}  // namespace

std::optional<Arguments> read_arguments(int argc, char** argv) {
    Arguments arguments;
    arguments.balancer = "rrcb";
    arguments.out = "out";
    Texts texts;
    Teuchos::CommandLineProcessor parser(false, true);
    set_options(parser, arguments, texts);
    const auto outcome = parser.parse(argc, argv);
    if (outcome == Teuchos::CommandLineProcessor::PARSE_HELP_PRINTED) return std::nullopt;
    if (outcome != Teuchos::CommandLineProcessor::PARSE_SUCCESSFUL)
        throw std::invalid_argument("an option is not known; --help lists them all");
    if (texts.cost != "count" && texts.cost != "learned")
        throw std::invalid_argument("--cost: '" + texts.cost + "' is not count or learned");
    arguments.learns_cost = texts.cost == "learned";
    make_balancer(arguments.balancer, {},
                  arguments.learns_cost ? PointWeights([] { return std::vector<double>(); })
                                        : PointWeights());
    if (arguments.scene.empty())
        throw std::invalid_argument("--scene=FILE is missing; examples/mpm/scenes has some");
    if (arguments.out.empty()) throw std::invalid_argument("--out: must name a folder");
    if (texts.every != "auto") arguments.every = number("every", texts.every, 0, 1, " or auto");
    arguments.vtk_every = number("vtk-every", texts.vtk_every, -1, 0);
    arguments.load_every = number("load-every", texts.load_every, 0, 0);
    arguments.every_time = number("every-time", texts.every_time, -1.0, 1e-300);
    arguments.state_every = number("state-every", texts.state_every, 0, 0);
    arguments.end_time = number("end-time", texts.end_time, 0.0, 1e-300);
    arguments.cell_size = number("cell-size", texts.cell_size, 0.0, 1e-300);
    return arguments;
}
