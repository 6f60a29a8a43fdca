#include "method.hpp"

#include "failure.hpp"
#include "options/option_table.hpp"
#include "paper/paper_text.hpp"
#include "text.hpp"

#include <algorithm>
#include <cctype>

namespace comparisons {

namespace {

using rrcb::Options;
using rrcb::PaperDomain;
using rrcb::PaperOptions;
using rrcb::Refine;

/// A parameter in brackets, and the parameter of the plug-in that it sets.
struct Key {
    std::string_view name;
    std::string_view parameter;
};

constexpr Key keys[] = {{"mesh", "RRCB_SUPPORT_MESH"}, {"refine", "RRCB_REFINE"},
                        {"tol", "IMBALANCE_TOL"},      {"central", "RRCB_CENTRAL_PARTS"},
                        {"machines", "RRCB_MACHINES"}, {"axes", "RRCB_AXES"}};

/// A parameter in brackets of the methods of the paper.
struct PaperKey {
    std::string_view name;
    const char* parameter;  ///< parameter of the plug-in
    const char* legal;      ///< description of the allowed values
    bool (*read)(std::string_view text, PaperOptions& options);
    std::string (*write)(const PaperOptions& options);
};

std::string upper_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

template <auto field>
std::string write_field(const PaperOptions& options) {
    return write_number(options.*field);
}

template <auto field, auto read>
bool read_field(std::string_view text, PaperOptions& options) {
    return read(options.*field, text);
}

bool read_mesh(std::string_view text, PaperOptions& options) {
    Options own;
    const bool is_legal = rrcb::read_option(*rrcb::find_option("cells_per_axis"), text, own);
    if (is_legal && own.expert.cells_per_axis != 0)
        options.cells_per_axis = own.expert.cells_per_axis;
    return is_legal && own.expert.cells_per_axis != 0;
}

constexpr PaperKey paper_keys[] = {
    {"mesh", "RRCB_SUPPORT_MESH", "a whole number from 1 to 4096", read_mesh,
     write_field<&PaperOptions::cells_per_axis>},
    {"cut", "RRCB_CUT_RULE", "WEIGHTED or MIDPOINT",
     read_field<&PaperOptions::cut_rule, rrcb::read_cut_rule>,
     [](const PaperOptions& options) { return rrcb::name_of(options.cut_rule); }},
    {"k", "RRCB_SIGMA_MULTIPLIER", "a number above 0",
     read_field<&PaperOptions::sigma_multiplier, rrcb::read_sigma_multiplier>,
     write_field<&PaperOptions::sigma_multiplier>},
    {"fraction", "RRCB_SAMPLE_FRACTION", "a number above 0, at most 1",
     read_field<&PaperOptions::sample_fraction, rrcb::read_sample_fraction>,
     write_field<&PaperOptions::sample_fraction>},
    {"seed", "RRCB_SEED", "a whole number, 0 or more",
     read_field<&PaperOptions::seed, rrcb::read_seed>, write_field<&PaperOptions::seed>}};

struct Entry {
    std::string_view name;
    std::string_view lb_method;
    std::optional<OwnOptions> options;
    std::vector<std::string_view> keys;
    std::vector<std::string> settings = {""};  ///< brackets with which it is one of all methods
};

Options refined(Refine refine) {
    Options options;
    options.refine = refine;
    return options;
}

// Returns the middle one of the meshes and multipliers that the paper studies, with all points.
PaperOptions of_paper(PaperDomain domain) {
    PaperOptions options;
    options.domain = domain;
    options.cells_per_axis = 4;
    options.sigma_multiplier = 1.5;
    options.sample_fraction = 1;
    return options;
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> table = {
        {"zoltan-rcb", "RCB", {}, {"reuse", "lock"}, {"", "[reuse]"}},
        {"zoltan-rib", "RIB", {}, {}},
        {"zoltan-hsfc", "HSFC", {}, {}},
        {"hilbert-counts", hilbert_counts, {}, {}},
#ifdef RRCB_HAS_ZOLTAN2
        {"zoltan2-mj", multijagged, {}, {}},
#endif
        {"root-rcb", "RRCB", of_paper(PaperDomain::points), {"cut"}},
        {"rrcb-sampled",
         "RRCB",
         of_paper(PaperDomain::sampled),
         {"mesh", "cut", "k", "fraction", "seed"},
         {"[mesh=2,k=1.5,fraction=0.25]", "[mesh=4,k=2,fraction=0.125]",
          "[mesh=6,k=2,fraction=0.125]", "[mesh=8,k=2,fraction=0.125]"}},
        {"rrcb",
         "RRCB",
         Options{},
         {"mesh", "refine", "tol", "reuse", "central", "machines", "axes"},
         {"[tol=1.1]", "[tol=1.05]", "", "[tol=1.001]"}},
        {"rrcb-exact", "RRCB", refined(Refine::exact), {"mesh", "axes"}},
        {"rrcb-arrays",
         on_arrays,
         Options{},
         {"mesh", "refine", "tol", "reuse", "central", "machines", "axes"}},
    };
    return table;
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
    const std::string_view value =
        equals == assignment.npos ? "" : trim(assignment.substr(equals + 1));
    const auto check = [&](bool is_legal, std::string_view legal) {
        if (!is_legal)
            throw Failure("--methods: " + method.label + ": " + std::string(name) + " must be " +
                          std::string(legal) + ", not '" + std::string(value) + "'");
    };
    if (auto* paper = std::get_if<PaperOptions>(&*method.options)) {
        const PaperKey& key = *std::ranges::find(paper_keys, name, &PaperKey::name);
        check(key.read(upper_case(value), *paper), key.legal);
    } else {
        const Key& key = *std::ranges::find(keys, name, &Key::name);
        const rrcb::Option& option = *rrcb::find_parameter(key.parameter);
        check(rrcb::read_option(option, value, std::get<Options>(*method.options)),
              rrcb::legal_values(option));
    }
    if (name == "seed") method.seed_given = true;
}

/// Adds the refinement, and those other parameters that differ from their defaults.
void add(const Options& options, ZoltanParameters& parameters) {
    for (const Key& key : keys) {
        const rrcb::Option& option = *rrcb::find_parameter(key.parameter);
        const std::string value = rrcb::write_option(option, options);
        if (key.name == "refine" || value != rrcb::write_option(option, Options{}))
            parameters.emplace_back(option.parameter, value);
    }
}

void add(const PaperOptions& options, ZoltanParameters& parameters) {
    parameters.emplace_back("RRCB_DOMAIN", rrcb::name_of(options.domain));
    for (const PaperKey& key : paper_keys)
        if (options.domain == PaperDomain::sampled || key.name == "cut")
            parameters.emplace_back(key.parameter, key.write(options));
}

}  // namespace

rrcb::Balance balance(const OwnOptions& options, const rrcb::Points& points, MPI_Comm comm) {
    if (const auto* paper = std::get_if<PaperOptions>(&options))
        return rrcb::balance_as_in_paper(points, comm, *paper);
    return rrcb::balance(points, comm, std::get<Options>(options));
}

std::string method_names() {
    return joined(entries(), &Entry::name);
}

Method read_method(std::string_view text) {
    text = trim(text);
    const std::size_t bracket = text.find('[');
    const Entry& entry = find_entry(text.substr(0, bracket));
    Method method{std::string(text), std::string(entry.lb_method), entry.options};
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
    return read_methods("zoltan-rcb,rrcb-sampled[mesh=8,k=2,fraction=0.125],rrcb,rrcb-exact");
}

std::vector<Method> all_methods() {
    std::vector<Method> methods;
    for (const Entry& entry : entries())
        for (const std::string& setting : entry.settings)
            methods.push_back(read_method(std::string(entry.name) + setting));
    return methods;
}

bool varies_with_seed(const Method& method) {
    const auto* paper = method.options ? std::get_if<PaperOptions>(&*method.options) : nullptr;
    return paper && paper->domain == PaperDomain::sampled && !method.seed_given;
}

Method with_next_seed(Method method, std::uint64_t offset) {
    if (varies_with_seed(method)) std::get<PaperOptions>(*method.options).seed += offset;
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
    if (method.lb_method == hilbert_counts) return {{"function", hilbert_counts}};
    if (method.lb_method == on_arrays) parameters = {{"function", on_arrays}};
    if (method.options)
        std::visit([&](const auto& options) { add(options, parameters); }, *method.options);
    if (method.reuses) parameters.emplace_back("RCB_REUSE", "1");
    if (method.locks_axes) parameters.emplace_back("RCB_LOCK_DIRECTIONS", "1");
    return parameters;
}

}  // namespace comparisons
