#include "method.hpp"

#include "bisection/domain_kinds.hpp"
#include "failure.hpp"
#include "options/option_table.hpp"
#include "text.hpp"

#include <algorithm>

namespace comparisons {

namespace {

using rrcb::DomainKind;
using rrcb::Options;
using rrcb::Refine;

/// A parameter in brackets, and the option it is.
struct Key {
    std::string_view name;
    std::string_view option;
};

constexpr Key keys[] = {{"mesh", "support_mesh"},  {"cut", "cut_rule"},
                        {"refine", "refine"},      {"tol", "imbalance_tolerance"},
                        {"k", "sigma_multiplier"}, {"fraction", "sample_fraction"},
                        {"seed", "seed"},          {"central", "central_parts"}};

struct Entry {
    std::string_view name;
    std::string_view lb_method;
    std::optional<DomainKind> domain;
    Refine refine;
    std::vector<std::string_view> keys;
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> table = {
        {"zoltan-rcb", "RCB", {}, {}, {"reuse", "lock"}},
        {"zoltan-rib", "RIB", {}, {}, {}},
        {"zoltan-hsfc", "HSFC", {}, {}, {}},
#ifdef RRCB_HAS_ZOLTAN2
        {"zoltan2-mj", multijagged, {}, {}, {}},
#endif
        {"root-rcb", "RRCB", DomainKind::points, Refine::none, {"cut"}},
        {"rrcb-sampled",
         "RRCB",
         DomainKind::sampled,
         Refine::none,
         {"mesh", "cut", "k", "fraction", "seed"}},
        {"rrcb",
         "RRCB",
         DomainKind::analytic,
         Refine::automatic,
         {"mesh", "cut", "refine", "tol", "reuse", "central"}},
        {"rrcb-exact", "RRCB", DomainKind::analytic, Refine::exact, {"mesh"}},
        {"rrcb-arrays",
         on_arrays,
         DomainKind::analytic,
         Refine::automatic,
         {"mesh", "cut", "refine", "tol", "central"}},
    };
    return table;
}

// The middle of the meshes and multipliers the paper studies, and all of its points.
Options paper_options() {
    Options options;
    options.support_mesh = 4;
    options.sigma_multiplier = 1.5;
    options.sample_fraction = 1;
    return options;
}

const Entry& find_entry(std::string_view name) {
    const auto found = std::ranges::find(entries(), name, &Entry::name);
    if (found == entries().end()) {
        throw Failure("--methods: unknown method '" + std::string(name) +
                      "'; choose from: " + method_names());
    }
    return *found;
}

void apply(Method& method, const Entry& entry, std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string_view name = trim(assignment.substr(0, equals));
    if (std::ranges::find(entry.keys, name) == entry.keys.end()) {
        throw Failure("--methods: " + std::string(entry.name) + " has no parameter '" +
                      std::string(name) + "'; it takes " +
                      (entry.keys.empty() ? "none" : joined(entry.keys)));
    }
    if (name == "reuse" || name == "lock") {
        if (equals != assignment.npos)
            throw Failure("--methods: " + method.label + ": " + std::string(name) +
                          " takes no value");
        (name == "reuse" ? method.reuses : method.locks_axes) = true;
        return;
    }
    const Key& key = *std::ranges::find(keys, name, &Key::name);
    const std::string_view value =
        equals == assignment.npos ? "" : trim(assignment.substr(equals + 1));
    const rrcb::Option& option = *rrcb::find_option(key.option);
    if (!rrcb::read_option(option, value, *method.options)) {
        throw Failure("--methods: " + method.label + ": " + std::string(name) + " must be " +
                      rrcb::legal_values(option) + ", not '" + std::string(value) + "'");
    }
    if (name == "seed") method.seed_given = true;
}

/// Words always, numbers where they are not the default; of the random points with them alone.
void add_options(ZoltanParameters& parameters, const Options& options) {
    const auto add = [&](std::string_view name, bool always) {
        const rrcb::Option& option = *rrcb::find_option(name);
        const std::string value = rrcb::write_option(option, options);
        if (always || value != rrcb::write_option(option, Options{}))
            parameters.emplace_back(option.parameter, value);
    };
    add("domain", true);
    add("support_mesh", false);
    add("cut_rule", true);
    add("refine", true);
    add("imbalance_tolerance", false);
    add("central_parts", false);
    if (!rrcb::traits_of(options.domain).is_random) return;
    for (const char* name : {"sigma_multiplier", "sample_fraction", "seed"}) add(name, true);
}

}  // namespace

std::string method_names() {
    return joined(entries(), &Entry::name);
}

Method read_method(std::string_view text) {
    text = trim(text);
    const std::size_t bracket = text.find('[');
    const Entry& entry = find_entry(text.substr(0, bracket));
    Method method{std::string(text), std::string(entry.lb_method), std::nullopt};
    if (entry.domain) {
        method.options = rrcb::traits_of(*entry.domain).is_random ? paper_options() : Options{};
        method.options->domain = *entry.domain;
        method.options->refine = entry.refine;
    }
    if (bracket == text.npos) return method;
    if (!text.ends_with(']')) {
        throw Failure("--methods: '" + method.label + "' lacks the closing bracket");
    }
    const std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
    for (const std::string_view assignment : split(inside, ',')) apply(method, entry, assignment);
    return method;
}

std::vector<Method> read_methods(std::string_view text) {
    std::vector<Method> methods;
    for (const std::string_view piece : split(text, ',')) {
        Method method = read_method(piece);
        if (std::ranges::find(methods, method.label, &Method::label) != methods.end()) {
            throw Failure("--methods: '" + method.label + "' is named twice; name it once");
        }
        methods.push_back(std::move(method));
    }
    return methods;
}

std::vector<Method> default_methods() {
    std::vector<Method> methods;
    for (const Entry& entry : entries()) {
        const std::string name(entry.name);
        if (name == "rrcb-sampled") {
            for (const char* setting : {"mesh=2,k=1.5,fraction=0.25", "mesh=4,k=2,fraction=0.125",
                                        "mesh=6,k=2,fraction=0.125", "mesh=8,k=2,fraction=0.125"}) {
                methods.push_back(read_method(name + '[' + setting + ']'));
            }
        } else if (name == "rrcb") {
            for (const char* setting : {"[tol=1.1]", "[tol=1.05]", "", "[tol=1.001]"}) {
                methods.push_back(read_method(name + setting));
            }
        } else {
            methods.push_back(read_method(name));
        }
    }
    return methods;
}

bool varies_with_seed(const Method& method) {
    return method.options && rrcb::traits_of(method.options->domain).is_random &&
           !method.seed_given;
}

Method with_next_seed(Method method, std::uint64_t offset) {
    if (varies_with_seed(method)) method.options->seed += offset;
    return method;
}

const char* lists_name(Lists lists) {
    return lists == Lists::parts ? "PARTS" : lists == Lists::exports ? "EXPORT" : "ALL";
}

ZoltanParameters zoltan_parameters(const Method& method, Lists lists) {
    if (method.lb_method == multijagged) {
        return {{"algorithm", multijagged},
                {"imbalance_tolerance", write_number(multijagged_tolerance)}};
    }
    ZoltanParameters parameters = {
        {"DEBUG_LEVEL", "0"}, {"LB_METHOD", method.lb_method}, {"RETURN_LISTS", lists_name(lists)}};
    if (method.lb_method == on_arrays) parameters = {{"function", on_arrays}};
    if (method.options) add_options(parameters, *method.options);
    if (method.reuses) parameters.emplace_back("RCB_REUSE", "1");
    if (method.locks_axes) parameters.emplace_back("RCB_LOCK_DIRECTIONS", "1");
    if (method.keeps_numbers) parameters.emplace_back("REMAP", "0");
    return parameters;
}

}  // namespace comparisons
