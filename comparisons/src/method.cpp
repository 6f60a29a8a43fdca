#include "method.hpp"

#include "failure.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

using rrcb::CutRule;
using rrcb::DomainKind;
using rrcb::Options;
using rrcb::Refine;

struct Key {
    std::string_view name;
    std::string_view range;
    bool (*read)(Options&, std::string_view);
};

template <typename Number, typename InRange>
bool store(std::string_view text, Number& field, InRange in_range) {
    const std::optional<Number> number = read_number<Number>(text);
    if (!number || !in_range(*number)) return false;
    field = *number;
    return true;
}

bool read_cut(Options& options, std::string_view text) {
    if (text != "weighted" && text != "midpoint") return false;
    options.cut_rule = text == "weighted" ? CutRule::weighted_fraction : CutRule::midpoint;
    return true;
}

bool read_refine(Options& options, std::string_view text) {
    if (text != "none" && text != "tolerance" && text != "exact") return false;
    options.refine = text == "none"    ? Refine::none
                     : text == "exact" ? Refine::exact
                                       : Refine::tolerance;
    return true;
}

constexpr Key keys[] = {
    {"mesh", "an integer, 1 ... 1024",
     [](Options& o, std::string_view text) {
         return store(text, o.support_mesh, [](int n) { return n >= 1 && n <= 1024; });
     }},
    {"cut", "weighted or midpoint", read_cut},
    {"refine", "none, tolerance or exact", read_refine},
    {"tol", "a number, 1 or more",
     [](Options& o, std::string_view text) {
         return store(text, o.imbalance_tolerance,
                      [](double t) { return std::isfinite(t) && t >= 1; });
     }},
    {"k", "a number above 0",
     [](Options& o, std::string_view text) {
         return store(text, o.sigma_multiplier, [](double k) { return std::isfinite(k) && k > 0; });
     }},
    {"fraction", "a number above 0, at most 1",
     [](Options& o, std::string_view text) {
         return store(text, o.sample_fraction, [](double f) { return f > 0 && f <= 1; });
     }},
    {"seed", "an integer, 0 or more",
     [](Options& o, std::string_view text) {
         return store(text, o.seed, [](std::uint64_t) { return true; });
     }},
};

struct Entry {
    std::string_view name;
    std::string_view lb_method;
    std::optional<DomainKind> domain;
    Refine refine;
    std::vector<std::string_view> keys;
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> table = {
        {"zoltan-rcb", "RCB", {}, {}, {}},
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
        {"rrcb", "RRCB", DomainKind::analytic, Refine::automatic, {"mesh", "cut", "refine", "tol"}},
        {"rrcb-exact", "RRCB", DomainKind::analytic, Refine::exact, {"mesh"}},
        {"rrcb-arrays",
         on_arrays,
         DomainKind::analytic,
         Refine::automatic,
         {"mesh", "cut", "refine", "tol"}},
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

std::string joined(const std::vector<std::string_view>& names) {
    std::string text;
    for (const std::string_view name : names) {
        if (!text.empty()) text += ", ";
        text += name;
    }
    return text;
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
    const Key& key = *std::ranges::find(keys, name, &Key::name);
    const std::string_view value =
        equals == assignment.npos ? "" : trim(assignment.substr(equals + 1));
    if (!key.read(*method.options, value)) {
        throw Failure("--methods: " + method.label + ": " + std::string(name) + " must be " +
                      std::string(key.range) + ", not '" + std::string(value) + "'");
    }
    if (name == "seed") method.seed_given = true;
}

void add_options(ZoltanParameters& parameters, const Options& options) {
    const char* const domains[] = {"ANALYTIC", "SAMPLED", "POINTS"};
    parameters.emplace_back("RRCB_DOMAIN", domains[static_cast<int>(options.domain)]);
    if (options.support_mesh > 0) {
        parameters.emplace_back("RRCB_SUPPORT_MESH", write_number(options.support_mesh));
    }
    parameters.emplace_back("RRCB_CUT_RULE",
                            options.cut_rule == CutRule::midpoint ? "MIDPOINT" : "WEIGHTED");
    const char* const refinements[] = {"AUTO", "NONE", "TOLERANCE", "EXACT"};
    parameters.emplace_back("RRCB_REFINE", refinements[static_cast<int>(options.refine)]);
    if (options.imbalance_tolerance != Options{}.imbalance_tolerance) {
        parameters.emplace_back("IMBALANCE_TOL", write_number(options.imbalance_tolerance));
    }
    if (options.domain != DomainKind::sampled) return;
    parameters.emplace_back("RRCB_SIGMA_MULTIPLIER", write_number(options.sigma_multiplier));
    parameters.emplace_back("RRCB_SAMPLE_FRACTION", write_number(options.sample_fraction));
    parameters.emplace_back("RRCB_SEED", write_number(options.seed));
}

}  // namespace

std::string method_names() {
    std::vector<std::string_view> names;
    for (const Entry& entry : entries()) names.push_back(entry.name);
    return joined(names);
}

Method read_method(std::string_view text) {
    text = trim(text);
    const std::size_t bracket = text.find('[');
    const Entry& entry = find_entry(text.substr(0, bracket));
    Method method{std::string(text), std::string(entry.lb_method), std::nullopt};
    if (entry.domain) {
        method.options = *entry.domain == DomainKind::sampled ? paper_options() : Options{};
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
    return method.options && method.options->domain == DomainKind::sampled && !method.seed_given;
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
    return parameters;
}

}  // namespace comparisons
