// What four ways of computing a standard deviation lose, as CSV on standard output.
//
//   rrcb_moments_error [most points]
//
// Two clouds: points uniform in an interval of length 1 that lies ever further off, and ever more
// points of two values.
#include "counter_random.hpp"

#include <rrcb/method/moments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

using Values = std::span<const double>;

/// sqrt(E[x^2] - E[x]^2); NaN where rounding leaves less than nothing.
double naive(Values values) {
    double sum = 0;
    double squares = 0;
    for (const double x : values) {
        sum += x;
        squares += x * x;
    }
    const auto count = static_cast<double>(values.size());
    return std::sqrt(squares / count - (sum / count) * (sum / count));
}

/// B. P. Welford: Note on a method for calculating corrected sums of squares and products (1962).
double welford(Values values) {
    double mean = 0;
    double squares = 0;
    double count = 0;
    for (const double x : values) {
        const double difference = x - mean;
        mean += difference / ++count;
        squares += difference * (x - mean);
    }
    return std::sqrt(squares / count);
}

struct Sums {
    double count, mean, squares;
};

/// Chan, Golub, LeVeque: Updating formulae and a pairwise algorithm for computing sample
/// variances (1979), down to single points.
Sums merged_in_pairs(Values values) {
    if (values.size() == 1) return {1, values[0], 0};
    const Sums a = merged_in_pairs(values.first(values.size() / 2));
    const Sums b = merged_in_pairs(values.subspan(values.size() / 2));
    const double count = a.count + b.count;
    const double difference = b.mean - a.mean;
    return {count, a.mean + difference * b.count / count,
            a.squares + b.squares + difference * difference * a.count * b.count / count};
}

double chan(Values values) {
    const Sums sums = merged_in_pairs(values);
    return std::sqrt(sums.squares / sums.count);
}

double ours(Values values) {
    const std::array<Values, 1> columns{values};
    const rrcb::Points points = rrcb::column_points(columns);
    const auto mesh = rrcb::make_support_mesh(rrcb::bounding_box(points), 1, 1);
    return rrcb::cell_moments(points, mesh)[0].moments.deviation[0];
}

template <class Term>
long double sum_in_pairs(Values values, const Term& term) {
    if (values.size() == 1) return term(values[0]);
    const std::size_t half = values.size() / 2;
    return sum_in_pairs(values.first(half), term) + sum_in_pairs(values.subspan(half), term);
}

double in_long_double(Values values) {
    const auto count = static_cast<long double>(values.size());
    const long double origin = values[0];
    const long double mean =
        sum_in_pairs(values, [&](double x) { return static_cast<long double>(x) - origin; }) /
        count;
    const long double squares = sum_in_pairs(values, [&](double x) {
        const long double difference = static_cast<long double>(x) - origin - mean;
        return difference * difference;
    });
    return static_cast<double>(std::sqrt(squares / count));
}

void print_errors(const char* cloud, double offset, Values values) {
    struct Method {
        const char* name;
        double (*deviation)(Values);
    };
    constexpr Method methods[] = {
        {"naive sums", naive}, {"Welford", welford}, {"Chan, pairwise", chan}, {"RRCB", ours}};
    const double reference = in_long_double(values);
    for (const Method& method : methods)
        std::printf("%s,%g,%zu,\"%s\",%.3g\n", cloud, offset, values.size(), method.name,
                    std::abs(method.deviation(values) / reference - 1));
}

}  // namespace

int main(int argc, char** argv) {
    const double most = argc > 1 ? std::atof(argv[1]) : 1e7;
    std::printf("cloud,offset,points,method,error\n");
    std::vector<double> values(static_cast<std::size_t>(std::min(most, 1e5)));
    for (int exponent = 0; exponent <= 15; ++exponent) {
        const double offset = std::pow(10.0, exponent);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = offset + comparisons::CounterRandom(1, i).uniform();
        print_errors("uniform", offset, values);
    }
    for (double count = 10; count <= most; count *= 10) {
        values.resize(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = i % 3 == 0 ? 1e6 + 0.1 : 1e6 + 0.8;
        print_errors("two values", 1e6, values);
    }
}
