#include "case_generator.hpp"

#include <algorithm>

namespace rrcb::test {

namespace {

namespace gen = rc::gen;

constexpr std::int32_t end_of_numbers = 1 << 20;

rc::Gen<Seed> any_seed() {
    const auto number = gen::inRange<std::int32_t>(0, end_of_numbers);
    return gen::build<Seed>(
        gen::set(&Seed::position, gen::container<std::array<std::int32_t, 3>>(number)),
        gen::set(&Seed::weight, number), gen::set(&Seed::owner, gen::inRange<std::int32_t>(0, 12)));
}

rc::Gen<Case::Shape> any_shape() {
    using Shape = Case::Shape;
    const auto space =
        gen::element(Space::unit, Space::lattice, Space::lattice, Space::far_off, Space::tiny,
                     Space::huge, Space::decades, Space::clusters, Space::flat);
    return gen::build<Shape>(
        gen::set(&Shape::dimension, gen::inRange<std::int32_t>(1, 4)),
        gen::set(&Shape::copies, gen::element<std::int32_t>(1, 1, 2, 7, 30)),
        gen::set(&Shape::spaces, gen::container<std::array<Space, 3>>(space)),
        gen::set(&Shape::weights,
                 gen::element(Weights::none, Weights::none, Weights::few_values, Weights::decades,
                              Weights::one_giant, Weights::zero, Weights::passive,
                              Weights::many_decades, Weights::subnormal)),
        gen::set(&Shape::sizes,
                 gen::element(Sizes::few_values, Sizes::few_values, Sizes::tiny, Sizes::decades,
                              Sizes::many_decades, Sizes::subnormal)),
        gen::set(&Shape::owners, gen::element(Owners::scattered, Owners::blocks, Owners::one_rank)),
        gen::set(&Shape::num_parts, gen::inRange<std::int32_t>(1, 14)),
        gen::set(&Shape::refine,
                 gen::element(Refine::tolerance, Refine::tolerance, Refine::exact, Refine::none)),
        gen::set(&Shape::support_mesh, gen::element<std::int32_t>(0, 0, 1, 3, 9)),
        gen::set(&Shape::central_parts, gen::element<std::int32_t>(0, 0, 2, 3)),
        gen::set(&Shape::tolerance, gen::element(1.01, 1.0, 1.1, 2.0)),
        gen::set(&Shape::plain_cuts, gen::element<std::int32_t>(0, 0, 0, 1)),
        gen::set(&Shape::group_size, gen::element<std::int32_t>(1, 1, 1, 2, 3, 5)),
        gen::set(&Shape::larger_below, gen::element<std::int32_t>(0, 0, 1)),
        gen::set(&Shape::choice, gen::inRange<std::int32_t>(0, end_of_numbers)));
}

/// No sizes, or one for each part with at least one above 0.
rc::Gen<std::vector<std::int32_t>> any_sizes(std::int32_t num_parts) {
    const auto sizes = gen::container<std::vector<std::int32_t>>(
        static_cast<std::size_t>(num_parts), gen::inRange<std::int32_t>(0, 5));
    const auto legal = gen::map(sizes, [](std::vector<std::int32_t> list) {
        if (std::ranges::count(list, 0) == std::ssize(list)) list.back() = 1;
        return list;
    });
    return gen::weightedOneOf<std::vector<std::int32_t>>(
        {{2, gen::just(std::vector<std::int32_t>())}, {1, legal}});
}

}  // namespace

rc::Gen<Case> any_case() {
    return gen::mapcat(any_shape(), [](const Case::Shape& shape) {
        return gen::build<Case>(
            gen::set(&Case::shape, gen::just(shape)),
            gen::set(&Case::part_sizes, any_sizes(shape.num_parts)),
            gen::set(&Case::seeds, gen::container<std::vector<Seed>>(any_seed())));
    });
}

}  // namespace rrcb::test
