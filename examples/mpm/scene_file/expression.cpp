#include "scene_file/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace mpm {

namespace {

/// A parser and the coordinates it reads.
struct Calculator {
    Vector at{};
    mu::Parser parser;
};

[[noreturn]] void refuse(const std::string& text, std::size_t position, const std::string& reason,
                         int dimension) {
    const std::string coordinates = dimension == 3 ? "x, y, z" : "x, y";
    throw std::invalid_argument("\"" + text + "\" at position " + std::to_string(position + 1) +
                                ": " + reason + "; possible: numbers, " + coordinates +
                                ", pi, + - * / ^ ( ), comparisons, a ? b : c, and functions as "
                                "sin, cos, exp, ln, sqrt, abs, min(a, b)");
}

/// Throws for a lone =, which muParser would take as an assignment to a coordinate.
void refuse_assignments(const std::string& text, int dimension) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '=') continue;
        const bool follows = i > 0 && std::string("<>!=").find(text[i - 1]) != std::string::npos;
        const bool leads = i + 1 < text.size() && text[i + 1] == '=';
        if (!follows && !leads) refuse(text, i, "'=' assigns; == compares", dimension);
    }
}

}  // namespace

Expression parse_expression(const std::string& text, int dimension) {
    refuse_assignments(text, dimension);
    const auto calculator = std::make_shared<Calculator>();
    constexpr const char* names[] = {"x", "y", "z"};
    try {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
            calculator->parser.DefineVar(names[a], &calculator->at[a]);
        calculator->parser.DefineConst("pi", std::numbers::pi);
        calculator->parser.SetExpr(text);
        int num_results = 0;
        calculator->parser.Eval(num_results);
        if (num_results != 1) refuse(text, text.find(','), "more than one number", dimension);
    } catch (const mu::Parser::exception_type& error) {
        const int position = std::clamp(error.GetPos(), 0, static_cast<int>(text.size()));
        refuse(text, static_cast<std::size_t>(position), error.GetMsg(), dimension);
    }
    return [calculator](const Vector& at) {
        calculator->at = at;
        return calculator->parser.Eval();
    };
}

}  // namespace mpm
