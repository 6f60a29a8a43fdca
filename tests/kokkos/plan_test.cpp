#include "ranks.hpp"
#include "views.hpp"

#include <rrcb/experimental/kokkos.hpp>
#include <rrcb/plan.hpp>

namespace rrcb::test {
namespace {

TEST(Destinations, are_those_of_plan) {
    for (const int num_parts : {1, 2, 7, 40}) {
        const Cloud cloud = lattice_cloud(20000, 2, 3 + rank(), false);
        experimental::KokkosBalance<Memory> balance{cuts_through(cloud, num_parts, 4), {}, {}, {}};
        balance.parts = Kokkos::View<Part*, Memory>("parts", cloud.count());
        experimental::assign(Device(), balance.cuts, view_of<double, Kokkos::LayoutLeft>(cloud),
                             balance.parts);
        const std::vector<Part> parts = on_host(balance.parts);
        const Plan expected = plan(parts, num_parts, MPI_COMM_WORLD);
        std::vector<int> ranks(cloud.count(), rank());
        for (std::size_t k = 0; k < expected.export_indices.size(); ++k)
            ranks[expected.export_indices[k]] = expected.export_ranks[k];
        EXPECT_EQ(on_host(experimental::destinations(Device(), balance, rank(), num_ranks())),
                  ranks);
    }
}

TEST(Destinations, of_no_points_are_none) {
    const experimental::KokkosBalance<Memory> balance{{.dimension = 2, .tree = {}}, {}, {}, {}};
    EXPECT_EQ(experimental::destinations(Device(), balance, rank(), num_ranks()).extent(0), 0u);
}

TEST(Assign, numbers_dealt_parts_and_refuses_others) {
    const Cloud cloud = lattice_cloud(500, 3, 3, false);
    Cuts cuts = cuts_through(cloud, 8, 4);
    cuts.shape = {4, false, 2};
    const auto x = view_of<float, Kokkos::LayoutRight>(cloud);
    const Kokkos::View<Part*, Memory> parts("parts", 500);
    experimental::assign(Device(), cuts, x, parts);
    std::vector<Part> expected(500);
    assign(cuts, cloud.points(), expected);
    EXPECT_EQ(on_host(parts), expected);
    const Kokkos::View<Part*, Memory> fewer("parts", 499);
    EXPECT_EQ(error_of([&] { experimental::assign(Device(), cuts, x, fewer); }),
              "parts must have one entry per point");
    Cuts planar = cuts;
    planar.dimension = 2;
    for (Cut& cut : planar.tree) cut.axis = 0;
    EXPECT_EQ(error_of([&] { experimental::assign(Device(), planar, x, parts); }),
              "positions must have the dimension of the cuts");
    cuts.tree.pop_back();
    EXPECT_NE(error_of([&] { experimental::assign(Device(), cuts, x, parts); }), "no error");
}

}  // namespace
}  // namespace rrcb::test
