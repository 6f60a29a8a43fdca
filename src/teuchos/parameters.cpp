#include "paper/paper_words.hpp"

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

template <class Number>
void add_number(ParameterList& list, const char* name, Number value,
                std::pair<Number, Number> range, const std::string& documentation) {
    list.set(name, value, documentation,
             Teuchos::rcp(new Teuchos::EnhancedNumberValidator<Number>(range.first, range.second)));
}

void add_choice(ParameterList& list, const char* name, const Choice& choice,
                const std::string& value, const std::string& documentation) {
    Teuchos::Array<std::string> names;
    Teuchos::Array<std::string> documents;
    Teuchos::Array<int> values;
    for (const Word& word : choice) {
        names.append(word.word);
        documents.append(word.text);
        values.append(word.value);
    }
    constexpr bool case_sensitive = false;
    list.set(name, value, documentation,
             Teuchos::rcp(new Teuchos::StringToIntegralParameterEntryValidator<int>(
                 names, documents, values, name, case_sensitive)));
}

constexpr double largest = std::numeric_limits<double>::max();

/// Returns true if the option is in the list, which is so if the plug-in has a parameter for it.
bool is_listed(const Option& option) {
    return *option.parameter != '\0';
}

/// Adds an option to a list, under the name of its parameter and with the library's default.
struct Adder {
    ParameterList& list;
    const Option& option;

    void operator()(const Range<int>& range) const {
        const int least = range.zero == nullptr ? range.least : 0;
        add_number(list, option.parameter, range.field.get(Options{}), {least, range.most},
                   documentation(option));
    }
    void operator()(const Range<double>& range) const {
        const double least = range.above_least ? std::nextafter(range.least, largest) : range.least;
        add_number(list, option.parameter, range.field.get(Options{}),
                   {least, std::min(range.most, largest)}, documentation(option));
    }
    void operator()(const Choice& choice) const {
        add_choice(list, option.parameter, choice, write_option(option, Options{}),
                   documentation(option));
    }
    void operator()(const Lists&) const {}
    void operator()(const Rows&) const {
        list.set(option.parameter, write_option(option, Options{}), documentation(option));
    }
};

void add_parameters_of_plug_in(ParameterList& list) {
    for (const Option& option : plug_in_table) visit_kind(option, Adder{list, option});
    // The seed is signed here, because Teuchos has no unsigned 64-bit number.
    add_number(list, seed_parameter.parameter, 1LL, {0LL, std::numeric_limits<long long>::max()},
               seed_parameter.documentation);
    list.set(dump_parameter.parameter, std::string(), dump_parameter.documentation);
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

/// Returns the entry; a whole number is converted to the type of the valid entry.
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
    const Option* option = find_parameter(name);
    if (option != nullptr && std::holds_alternative<Rows>(option->kind)) {
        Options unused;
        return read_option(*option, entry.getValue<std::string>(nullptr), unused);
    }
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
    const std::vector<std::string> names = names_of(valid);
    std::string known;
    for (const std::string& choice : names) known += (known.empty() ? "" : ", ") + choice;
    throw Error(ErrorCode::invalid_argument, "unknown parameter '" + name + "'; choose from: " +
                                                 known + suggestion(name, names));
}

/// Returns the valid list with the values of `given`. Throws Error if one of these is illegal.
ParameterList completed(const ParameterList& given) {
    ParameterList list = *valid_parameters();
    for (const std::string& name : names_of(given)) {
        ParameterEntry* valid = list.getEntryPtr(name);
        if (valid == nullptr) reject_name(name, list);
        const ParameterEntry entry = promoted(given.getEntry(name), *valid);
        if (!is_legal(entry, *valid, name)) reject(name, entry, *valid);
        const auto validator = valid->validator();
        valid->setAnyValue(entry.getAny(false));
        valid->setValidator(validator);  // setting a new value has removed it
    }
    return list;
}

/// Returns the value of an entry as a text for the plug-in. 0, the library's own choice, becomes
/// Zoltan's DEFAULT.
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
        for (const Option& option : option_table)
            if (is_listed(option)) visit_kind(option, Adder{*list, option});
        add_parameters_of_plug_in(*list);
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
    for (const Option& option : option_table)
        if (is_listed(option))
            read_option(option, zoltan_string(all.getEntry(option.parameter)), options);
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
