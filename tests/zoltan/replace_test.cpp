#include "program.hpp"
#include "regions.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

// Runs with RRCB_REPLACE=RCB in the environment, which CTest sets.
namespace rrcb::zoltan_test {
namespace {

struct TenParts : Program {
    TenParts() {
        scatter_points(*this, 500);
        set({{"RETURN_LISTS", "PARTS"}, {"NUM_GLOBAL_PARTS", "10"}});
        // RCB knows nothing of this one: it tells who partitions.
        set("RRCB_DOMAIN", "SAMPLED");
    }
    std::vector<int> parts() { return parts_by_object(partition()); }
};

std::vector<int> parts_of_method(const char* method) {
    TenParts program;
    EXPECT_EQ(program.set("LB_METHOD", method), ZOLTAN_OK);
    return program.parts();
}

TEST(Replacement, is_asked_for) {
    ASSERT_STREQ(std::getenv("RRCB_REPLACE"), "RCB");
}

TEST(Replacement, answers_rcb_and_the_default_with_rrcb) {
    const std::vector<int> rrcb = parts_of_method("RRCB");
    EXPECT_EQ(parts_of_method("RCB"), rrcb);
    EXPECT_EQ(parts_of_method("rcb"), rrcb);
    EXPECT_EQ(TenParts().parts(), rrcb);
}

TEST(Replacement, leaves_other_methods_alone_and_returns_to_rcb) {
    TenParts program;
    const std::vector<int> rrcb = program.parts();
    EXPECT_EQ(program.set("LB_METHOD", "RIB"), ZOLTAN_OK);
    EXPECT_NE(program.parts(), rrcb);
    EXPECT_EQ(program.set("LB_METHOD", "RCB"), ZOLTAN_OK);
    EXPECT_EQ(program.parts(), rrcb);
    EXPECT_EQ(program.set("LB_METHOD", "NO_SUCH_METHOD"), ZOLTAN_FATAL);
    EXPECT_EQ(program.parts(), rrcb);
}

TEST(Replacement, holds_for_copies_and_look_ups) {
    TenParts program;
    program.set("KEEP_CUTS", "1");
    const std::vector<int> parts = program.parts();
    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Place place = program.place_of(&program.coordinates[2 * i], copy);
        EXPECT_EQ(place.code, ZOLTAN_OK);
        EXPECT_EQ(place.part, parts[i]);
    }
    Zoltan_Destroy(&copy);
}

constexpr int num_regions = 5;

std::vector<std::array<double, 3>> faces_of_regions(const Program& program) {
    std::vector<std::array<double, 3>> faces;
    for (int part = 0; part < num_regions; ++part) {
        const Region region = region_of(program.zz, part);
        EXPECT_EQ(region.code, ZOLTAN_OK);
        faces.push_back(region.lower);
        faces.push_back(region.upper);
    }
    return faces;
}

TEST(Replacement, leaves_cuts_within_the_tolerance_unless_told_not_to) {
    Scattered program(2000, {{"KEEP_CUTS", "1"}, {"IMBALANCE_TOL", "1.1"}, {"REMAP", "0"}});
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_regions));
    const auto faces_after_a_move = [&] {
        for (double& x : program.coordinates) x += 1e-3 * x;
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        return faces_of_regions(program);
    };
    const auto first = faces_after_a_move();
    EXPECT_EQ(faces_after_a_move(), first);
    program.set("RCB_SET_DIRECTIONS", "1");
    const auto with_other_axes = faces_after_a_move();
    EXPECT_NE(with_other_axes, first);
    EXPECT_EQ(faces_after_a_move(), with_other_axes);
    program.set("RCB_REUSE", "0");
    const auto cold = faces_after_a_move();
    EXPECT_NE(faces_after_a_move(), cold);
    program.set("RCB_REUSE", "DEFAULT");
    const auto again = faces_after_a_move();
    EXPECT_EQ(faces_after_a_move(), again);
}

TEST(Replacement, leaves_the_handles_that_zoltan_makes_for_itself) {
    Scattered program(300);
    use_hier(program, "RCB");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.exports.count > 0, program.num_ranks > 1);
}

/// What rank 0 finds on stderr while `action` runs there and elsewhere; "" on other ranks.
template <typename Action>
std::string printed_on_rank_0(int rank, Action action) {
    testing::internal::CaptureStderr();
    action();
    const std::string text = testing::internal::GetCapturedStderr();
    return rank == 0 ? text : "";
}

int count(const std::string& text, const std::string& word) {
    int found = 0;
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
    return found;
}

TEST(Replacement, says_once_which_geometric_methods_stay_zoltans) {
    Scattered program(100);
    const auto run = [&](const char* method) {
        return printed_on_rank_0(program.rank, [&] {
            program.set({{"LB_METHOD", method}, {"DEBUG_LEVEL", "0"}});
            program.partition();
            program.set("DEBUG_LEVEL", "1");
            program.partition();
            program.partition();
        });
    };
    const int once = program.rank == 0 ? 1 : 0;
    EXPECT_EQ(count(run("RIB"), "LB_METHOD=RIB stays Zoltan's"), once);
    EXPECT_EQ(count(run("HSFC"), "LB_METHOD=HSFC stays Zoltan's"), once);
    EXPECT_EQ(count(run("BLOCK"), "stays Zoltan's"), 0);
    EXPECT_EQ(count(run("RCB"), "stays Zoltan's"), 0);
}

TEST(Replacement, says_once_that_rcb_inside_hier_stays_zoltans) {
    Scattered program(100);
    const auto run = [&](const char* inner) {
        use_hier(program, inner);
        program.set("DEBUG_LEVEL", "1");
        return printed_on_rank_0(program.rank, [&] {
            program.partition();
            program.partition();
        });
    };
    EXPECT_EQ(count(run("RRCB"), "stays Zoltan's"), 0);
    const int once = program.rank == 0 && program.num_ranks > 1 ? 1 : 0;
    EXPECT_EQ(count(run("RCB"), "RCB inside HIER stays Zoltan's"), once);
}

/// Functions of Zoltan itself, past the plug-in.
template <typename Function>
void find_in_zoltan(Function& function, const char* name) {
    void* library = dlopen("libtrilinos_zoltan.so", RTLD_NOW | RTLD_LOCAL);
    function = reinterpret_cast<Function>(dlsym(library, name));
}

/// Handles that the plug-in does not know, and what one of them keeps of RCB in Zoltan's own
/// buffer.
struct ZoltansOwn : Program {
    ZoltansOwn() {
        scatter_points(*this, 300);
        find_in_zoltan(create, "Zoltan_Create");
        find_in_zoltan(serialized_size, "Zoltan_Serialize_Size");
        find_in_zoltan(serialize, "Zoltan_Serialize");
        Zoltan_Struct* first = create(MPI_COMM_WORLD);
        register_callbacks(first);
        gid_width = 2;
        for (const auto& [name, value] : {std::pair{"LB_METHOD", "RCB"},
                                          {"KEEP_CUTS", "1"},
                                          {"NUM_GID_ENTRIES", "2"},
                                          {"NUM_GLOBAL_PARTS", "7"},
                                          {"RETURN_LISTS", "PARTS"},
                                          {"DEBUG_LEVEL", "0"}})
            EXPECT_EQ(Zoltan_Set_Param(first, name, value), ZOLTAN_OK);
        EXPECT_EQ(partition(first).code, ZOLTAN_OK);
        buffer.resize(serialized_size(first));
        EXPECT_EQ(serialize(first, buffer.size(), buffer.data()), ZOLTAN_OK);
        Zoltan_Destroy(&first);
        handle = create(MPI_COMM_WORLD);
        fill(handle);
    }
    ~ZoltansOwn() { Zoltan_Destroy(&handle); }

    void fill(Zoltan_Struct* filled) {
        EXPECT_EQ(Zoltan_Deserialize(filled, buffer.size(), buffer.data()), ZOLTAN_OK);
        register_callbacks(filled);
    }

    decltype(&Zoltan_Create) create = nullptr;
    decltype(&Zoltan_Serialize_Size) serialized_size = nullptr;
    decltype(&Zoltan_Serialize) serialize = nullptr;
    std::vector<char> buffer;
    Zoltan_Struct* handle = nullptr;  ///< filled from the buffer
};

int different_look_ups(ZoltansOwn& program, Zoltan_Struct* handle) {
    int different = 0;
    for (std::size_t i = 0; i < program.coordinates.size(); i += 2) {
        const Place expected = program.place_of(&program.coordinates[i], program.handle);
        const Place found = program.place_of(&program.coordinates[i], handle);
        if (expected.part < 0 || found.part != expected.part) ++different;
    }
    return different;
}

void expect_same_partition(ZoltansOwn& program, Zoltan_Struct* handle) {
    const Outcome expected = program.partition(program.handle);
    const Outcome found = program.partition(handle);
    EXPECT_EQ(found.code, ZOLTAN_OK);
    EXPECT_EQ(found.num_gid, 2);
    EXPECT_EQ(found.exports.parts, expected.exports.parts);
    EXPECT_EQ(found.exports.global_ids, expected.exports.global_ids);
    EXPECT_EQ(different_look_ups(program, handle), 0);
}

TEST(Replacement, leaves_a_handle_to_zoltan_that_is_filled_from_a_buffer_of_its_own) {
    ZoltansOwn own;
    Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_WORLD);
    own.fill(handle);
    EXPECT_EQ(different_look_ups(own, handle), 0);
    expect_same_partition(own, handle);
    // Asked for by name, RCB is Zoltan's as well.
    EXPECT_EQ(Zoltan_Set_Param(handle, "LB_METHOD", "RCB"), ZOLTAN_OK);
    EXPECT_EQ(Zoltan_Set_Param(own.handle, "LB_METHOD", "RCB"), ZOLTAN_OK);
    expect_same_partition(own, handle);
    Zoltan_Destroy(&handle);
}

TEST(Replacement, tells_of_a_buffer_of_zoltans_own_unless_nothing_is_to_be_told) {
    ZoltansOwn own;
    for (const char* level : {"0", "1"}) {
        Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_WORLD);
        Zoltan_Set_Param(handle, "DEBUG_LEVEL", level);
        const std::string text = printed_on_rank_0(own.rank, [&] { own.fill(handle); });
        EXPECT_EQ(count(text, "stays with Zoltan"), own.rank == 0 && *level == '1' ? 1 : 0);
        Zoltan_Destroy(&handle);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
