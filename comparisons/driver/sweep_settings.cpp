#include "sweep_settings.hpp"

#include <algorithm>
#include <string>

namespace comparisons {

namespace {

using Values = std::vector<std::string>;

/// Brackets with what is not empty of two parameters.
std::string bracket(const std::string& first, const std::string& second) {
    if (first.empty() && second.empty()) return "";
    return '[' + first + (first.empty() || second.empty() ? "" : ",") + second + ']';
}

void add_rrcb(std::vector<Method>& settings) {
    for (const std::string mesh : {"", "mesh=2", "mesh=4", "mesh=8", "mesh=16", "mesh=32"}) {
        for (const std::string refinement :
             {"refine=none", "tol=1.1", "tol=1.05", "", "tol=1.001"}) {
            settings.push_back(read_method("rrcb" + bracket(mesh, refinement)));
        }
        settings.push_back(read_method("rrcb-exact" + bracket(mesh, "")));
    }
}

std::vector<Method> sampled(const Values& meshes, const Values& multipliers,
                            const Values& fractions) {
    std::vector<Method> settings;
    for (const std::string& mesh : meshes) {
        for (const std::string& k : multipliers) {
            for (const std::string& fraction : fractions) {
                settings.push_back(read_method("rrcb-sampled[mesh=" + mesh + ",k=" + k +
                                               ",fraction=" + fraction + "]"));
            }
        }
    }
    return settings;
}

}  // namespace

std::vector<Method> cost_settings() {
    std::vector<Method> settings = read_methods(method_names());
    std::erase_if(settings, [](const Method& method) { return method.label.starts_with("rrcb"); });
    for (Method& method : sampled({"4", "10", "32"}, {"1.5"}, {"1", "0.125"})) {
        settings.push_back(std::move(method));
    }
    add_rrcb(settings);
    settings.push_back(read_method("rrcb-arrays"));
    return settings;
}

std::vector<Method> paper_settings(bool quick) {
    if (quick) return sampled({"2", "10"}, {"1.5"}, {"1", "0.125"});
    return sampled({"2", "4", "6", "8", "10"}, {"1", "1.5", "2", "2.5"},
                   {"1", "0.5", "0.25", "0.125"});
}

std::vector<Method> standard_settings() {
    return read_methods(
        "zoltan-rcb,root-rcb,rrcb,rrcb-exact,rrcb-sampled[mesh=4,k=1.5,fraction=1]");
}

std::vector<Method> study_settings(bool quick) {
    std::vector<Method> settings = standard_settings();
    settings.pop_back();
    for (Method& method : paper_settings(quick)) settings.push_back(std::move(method));
    return settings;
}

std::vector<Method> winning_settings() {
    std::vector<Method> settings = sampled({"2"}, {"1.5"}, {"0.25"});
    for (Method& method : sampled({"4", "6", "8"}, {"2"}, {"0.125"})) {
        settings.push_back(std::move(method));
    }
    return settings;
}

std::vector<Method> repeated_settings(bool quick) {
    if (quick) return read_methods("rrcb,rrcb-sampled[mesh=2,k=1.5,fraction=1]");
    std::vector<Method> settings = standard_settings();
    for (Method& method : winning_settings()) settings.push_back(std::move(method));
    return settings;
}

std::vector<Method> cycle_settings(bool quick) {
    if (quick) return read_methods("rrcb,rrcb-sampled[mesh=4,k=1.5,fraction=1]");
    std::vector<Method> settings =
        sampled({"4"}, {"1", "1.5", "1.7320508", "2", "2.5"}, {"1", "0.125"});
    for (Method& method : winning_settings()) {
        // One of them is there already.
        if (std::ranges::find(settings, method.label, &Method::label) == settings.end())
            settings.push_back(std::move(method));
    }
    for (Method& method : read_methods("rrcb[refine=none],rrcb,rrcb-exact,zoltan-rcb")) {
        settings.push_back(std::move(method));
    }
    return settings;
}

}  // namespace comparisons
