#include "sweep_settings.hpp"

#include <string>

namespace comparisons {

namespace {

using Values = std::vector<std::string>;

void add_rrcb(std::vector<Method>& settings) {
    const Values meshes = {"4", "8", "16", "32"};
    for (const std::string& mesh : meshes) {
        settings.push_back(read_method("rrcb[mesh=" + mesh + ",refine=none]"));
    }
    settings.push_back(read_method("rrcb[refine=none]"));
    for (const std::string tolerance : {"1.1", "1.05", "1.01", "1.001"}) {
        settings.push_back(read_method("rrcb[tol=" + tolerance + "]"));
        for (const std::string mesh : {"8", "32"}) {
            settings.push_back(read_method("rrcb[mesh=" + mesh + ",tol=" + tolerance + "]"));
        }
    }
    settings.push_back(read_method("rrcb-exact"));
    for (const std::string& mesh : meshes) {
        settings.push_back(read_method("rrcb-exact[mesh=" + mesh + "]"));
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
    return settings;
}

std::vector<Method> paper_settings(bool quick) {
    if (quick) return sampled({"2", "10"}, {"1.5"}, {"1", "0.125"});
    return sampled({"2", "4", "6", "8", "10"}, {"1", "1.5", "2", "2.5"},
                   {"1", "0.5", "0.25", "0.125"});
}

}  // namespace comparisons
