#include <rrcb/error.hpp>
#include <rrcb/teuchos/parameters.hpp>

#include <Teuchos_StandardParameterEntryValidators.hpp>
#include <Teuchos_XMLParameterListCoreHelpers.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace rrcb::teuchos {

namespace {

using Teuchos::ParameterEntry;
using Teuchos::ParameterList;

constexpr int most_cells = 4096;
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

template <class Number>
void add_number(ParameterList& list, const char* name, Number value,
                std::pair<Number, Number> range, const char* documentation) {
    list.set(name, value, documentation,
             Teuchos::rcp(new Teuchos::EnhancedNumberValidator<Number>(range.first, range.second)));
}

template <class Value>
struct Word {
    const char* word;
    Value value;
    const char* documentation;
};

/// The first word is the default.
template <class Value>
void add_choice(ParameterList& list, const char* name, const std::vector<Word<Value>>& words,
                const char* documentation) {
    const auto size = static_cast<Teuchos::Array<std::string>::size_type>(words.size());
    Teuchos::Array<std::string> names(size);
    Teuchos::Array<std::string> documents(size);
    Teuchos::Array<Value> values(size);
    for (auto i = 0 * size; i < size; ++i) {
        const Word<Value>& word = words[static_cast<std::size_t>(i)];
        names[i] = word.word;
        documents[i] = word.documentation;
        values[i] = word.value;
    }
    constexpr bool case_sensitive = false;
    list.set(name, names[0], documentation,
             Teuchos::rcp(new Teuchos::StringToIntegralParameterEntryValidator<Value>(
                 names, documents, values, name, case_sensitive)));
}

void add_partition(ParameterList& list) {
    const Options defaults;
    add_number(list, "NUM_GLOBAL_PARTS", defaults.num_parts, {0, std::numeric_limits<int>::max()},
               "Parts to make: a whole number, 1 or more; 0: one per rank.");
    add_number(list, "RRCB_SUPPORT_MESH", defaults.support_mesh, {0, most_cells},
               "Cells per axis of each rank's support mesh: a whole number from 1 to 4096; 0: as "
               "many as suit the points.");
    add_choice<DomainKind>(
        list, "RRCB_DOMAIN",
        {{"ANALYTIC", DomainKind::analytic, "each cell a uniform density with the cell's moments"},
         {"SAMPLED", DomainKind::sampled, "pseudo-random points with the cell's moments"},
         {"POINTS", DomainKind::points, "the points themselves, all gathered at the root"}},
        "What the root bisects in place of the points: ANALYTIC, SAMPLED or POINTS.");
    add_choice<CutRule>(list, "RRCB_CUT_RULE",
                        {{"WEIGHTED", CutRule::weighted_fraction, "by weight"},
                         {"MIDPOINT", CutRule::midpoint, "by extent"}},
                        "Where a box is cut across its longest axis: WEIGHTED (where the weight "
                        "below is the share of the parts below) or MIDPOINT (at that share of the "
                        "extent).");
}

void add_refinement(ParameterList& list) {
    add_choice<Refine>(
        list, "RRCB_REFINE",
        {{"AUTO", Refine::automatic, "TOLERANCE for the analytic domain, NONE for others"},
         {"NONE", Refine::none, "the estimate stands"},
         {"TOLERANCE", Refine::tolerance, "until the imbalance is within IMBALANCE_TOL"},
         {"EXACT", Refine::exact, "to the weighted median"}},
        "How far the estimated cuts are moved by what the ranks really hold: AUTO, NONE, TOLERANCE "
        "or EXACT.");
    add_choice<Coincident>(
        list, "RRCB_COINCIDENT",
        {{"TOGETHER", Coincident::together, "they share a part"},
         {"DIVIDE", Coincident::divide,
          "by number; where the list is not given to the plug-in it "
          "does so"}},
        "What becomes of points in one place where the balance asked for divides them: TOGETHER or "
        "DIVIDE.");
    add_number(list, "IMBALANCE_TOL", Options{}.imbalance_tolerance, {1.0, largest},
               "Heaviest part / mean part to reach with RRCB_REFINE=TOLERANCE: a number, 1 or "
               "more.");
}

void add_sampling(ParameterList& list) {
    const Options defaults;
    add_number(list, "RRCB_SIGMA_MULTIPLIER", defaults.sigma_multiplier, {smallest, largest},
               "SAMPLED: half-width of a cell's sampling box in standard deviations: a number "
               "above 0.");
    add_number(list, "RRCB_SAMPLE_FRACTION", defaults.sample_fraction, {smallest, 1.0},
               "SAMPLED: points drawn per real point: a number above 0, at most 1.");
    add_number(list, "RRCB_SEED", static_cast<long long>(defaults.seed),
               {0, std::numeric_limits<long long>::max()},
               "SAMPLED: seed of the points: a whole number, 0 or more.");
}

void add_dump(ParameterList& list) {
    list.set("RRCB_DUMP", std::string(),
             "Plug-in only: folder to write the input of calls to: a string; empty: none.");
    add_choice<int>(list, "RRCB_DUMP_WHEN",
                    {{"FAILURE", 0, "when a call fails"}, {"ALWAYS", 1, "at every call"}},
                    "Plug-in only: when to write to RRCB_DUMP: FAILURE or ALWAYS.");
}

std::string text_of(const ParameterEntry& entry) {
    if (entry.isList()) return "a list";
    std::ostringstream text;
    if (entry.isType<std::string>()) {
        text << '\'' << entry.getValue<std::string>(nullptr) << '\'';
    } else {
        text << entry.getAny(false);
    }
    text << " (" << entry.getAny(false).typeName() << ')';
    return text.str();
}

[[noreturn]] void reject(const std::string& name, const ParameterEntry& given,
                         const ParameterEntry& valid) {
    throw Error(ErrorCode::invalid_argument,
                "parameter " + name + " must not be " + text_of(given) + ". " + valid.docString());
}

/// The entry with a whole number turned into the type that is due.
ParameterEntry promoted(ParameterEntry entry, const ParameterEntry& valid) {
    if (entry.isList() || !entry.isType<int>()) return entry;
    const int number = entry.getValue<int>(nullptr);
    if (valid.isType<double>()) entry.setValue(static_cast<double>(number));
    if (valid.isType<long long>()) entry.setValue(static_cast<long long>(number));
    return entry;
}

bool is_legal(const ParameterEntry& entry, const ParameterEntry& valid, const std::string& name) {
    if (entry.isList() || entry.getAny(false).type() != valid.getAny(false).type()) return false;
    if (entry.isType<double>() && !std::isfinite(entry.getValue<double>(nullptr))) return false;
    if (valid.validator().is_null()) return true;
    try {
        valid.validator()->validate(entry, name, "");
    } catch (const Teuchos::Exceptions::InvalidParameter&) {
        return false;
    }
    return true;
}

std::vector<std::string> names_of(const ParameterList& list) {
    std::vector<std::string> names;
    for (auto entry = list.begin(); entry != list.end(); ++entry) names.push_back(list.name(entry));
    return names;
}

[[noreturn]] void reject_name(const std::string& name, const ParameterList& valid) {
    std::string known;
    for (const std::string& choice : names_of(valid)) known += (known.empty() ? "" : ", ") + choice;
    throw Error(ErrorCode::invalid_argument,
                "unknown parameter '" + name + "'; choose from: " + known);
}

/// The valid list with the values of `given`. Throws Error.
ParameterList completed(const ParameterList& given) {
    ParameterList list = *valid_parameters();
    for (const std::string& name : names_of(given)) {
        ParameterEntry* valid = list.getEntryPtr(name);
        if (valid == nullptr) reject_name(name, list);
        const ParameterEntry entry = promoted(given.getEntry(name), *valid);
        if (!is_legal(entry, *valid, name)) reject(name, entry, *valid);
        const auto validator = valid->validator();
        valid->setAnyValue(entry.getAny(false));
        valid->setValidator(validator);  // which a new value takes away
    }
    return list;
}

/// As the plug-in reads it; Zoltan knows no number for what it is to choose itself.
std::string zoltan_string(const ParameterEntry& entry) {
    const Teuchos::any& value = entry.getAny(false);
    if (entry.isType<std::string>()) return Teuchos::any_cast<std::string>(value);
    if (entry.isType<long long>()) return std::to_string(Teuchos::any_cast<long long>(value));
    if (entry.isType<int>()) {
        const int number = Teuchos::any_cast<int>(value);
        return number == 0 ? "DEFAULT" : std::to_string(number);
    }
    char text[32];
    const auto end =
        std::to_chars(std::begin(text), std::end(text), Teuchos::any_cast<double>(value));
    return {text, end.ptr};
}

}  // namespace

Teuchos::RCP<const ParameterList> valid_parameters() {
    static const Teuchos::RCP<const ParameterList> valid = [] {
        const auto list = Teuchos::parameterList("RRCB");
        add_partition(*list);
        add_refinement(*list);
        add_sampling(*list);
        add_dump(*list);
        return list;
    }();
    return valid;
}

ParameterList read_parameters(const std::string& file) {
    const auto fail = [&](const std::string& what) -> Error {
        return {ErrorCode::invalid_argument, file + ": " + what};
    };
    const std::string ending = file.substr(std::min(file.rfind('.'), file.size()));
    if (ending != ".xml" && ending != ".yaml" && ending != ".yml")
        throw fail("the name of a file of parameters ends in .xml, .yaml or .yml");
    if (!std::ifstream(file)) throw fail("cannot be opened");
    try {
        return *(ending == ".xml" ? Teuchos::getParametersFromXmlFile(file)
                                  : Teuchos::getParametersFromYamlFile(file));
    } catch (const std::exception& error) {
        throw fail(std::string("is no list of parameters: ") + error.what());
    }
}

Options options_from(const ParameterList& list) {
    const ParameterList all = completed(list);
    Options options;
    options.num_parts = all.get<int>("NUM_GLOBAL_PARTS");
    options.support_mesh = all.get<int>("RRCB_SUPPORT_MESH");
    options.domain = Teuchos::getIntegralValue<DomainKind>(all, "RRCB_DOMAIN");
    options.cut_rule = Teuchos::getIntegralValue<CutRule>(all, "RRCB_CUT_RULE");
    options.refine = Teuchos::getIntegralValue<Refine>(all, "RRCB_REFINE");
    options.coincident = Teuchos::getIntegralValue<Coincident>(all, "RRCB_COINCIDENT");
    options.imbalance_tolerance = all.get<double>("IMBALANCE_TOL");
    options.sigma_multiplier = all.get<double>("RRCB_SIGMA_MULTIPLIER");
    options.sample_fraction = all.get<double>("RRCB_SAMPLE_FRACTION");
    options.seed = static_cast<std::uint64_t>(all.get<long long>("RRCB_SEED"));
    return options;
}

std::vector<std::pair<std::string, std::string>> zoltan_strings(const ParameterList& list) {
    const ParameterList all = completed(list);
    std::vector<std::pair<std::string, std::string>> strings;
    for (const std::string& name : names_of(list))
        strings.emplace_back(name, zoltan_string(all.getEntry(name)));
    return strings;
}

}  // namespace rrcb::teuchos
