#pragma once

#include "../support/common.hpp"

#include <zoltan.h>

namespace rrcb::zoltan_test {

/// A call of LB_Partition or LB_Balance, copied out of Zoltan's arrays.
struct ListCopy {
    int count = 0;
    bool has_global_ids = false, has_local_ids = false, has_ranks = false, has_parts = false;
    std::vector<std::vector<ZOLTAN_ID_TYPE>> global_ids, local_ids;
    std::vector<int> ranks, parts;
};

struct Outcome {
    int code = 0, changes = 0, num_gid = 0, num_lid = 0;
    ListCopy imports, exports;
};

/// The answer of Zoltan_LB_Point_PP_Assign.
struct Place {
    int code = 0, rank = -7, part = -7;
    bool operator==(const Place&) const = default;
};

/// Objects that Zoltan has packed and unpacked.
struct Migration {
    int packed = 0, unpacked = 0;
};

/// One rank's data and callbacks, and a handle on which to set parameters.
struct Program {
    explicit Program(int dimension = 2, MPI_Comm comm = MPI_COMM_WORLD);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void add(std::vector<double> position, float weight = 1);
    void register_callbacks(Zoltan_Struct* handle);
    int set(const char* name, const std::string& value);
    void set(std::initializer_list<std::pair<const char*, std::string>> settings);
    void set_size(int part, float size);  ///< of a part of all ranks

    Outcome partition();
    Outcome partition(Zoltan_Struct* handle);
    Outcome balance();
    Place place_of(const double* position, Zoltan_Struct* handle = nullptr) const;  ///< own handle

    int rank = 0, num_ranks = 1;
    int dimension;
    std::vector<double> coordinates;
    std::vector<float> weights;
    int gid_width = 1, lid_width = 1;
    ZOLTAN_ID_TYPE first_id = 0;                             ///< added to every word of an id
    std::function<float(int object, int k)> further_weight;  ///< for OBJ_WEIGHT_DIM > 1, k >= 1

    /// Called at the start of each callback with its name; may set the code or throw.
    std::function<void(const std::string& callback, int& code)> fault;
    int reported_dimension;
    int count_offset = 0;
    bool keep_lists = false;  ///< lists stay allocated in `raw` for further calls of Zoltan

    struct RawList {
        int count = 0;
        ZOLTAN_ID_PTR global_ids = nullptr, local_ids = nullptr;
        int *ranks = nullptr, *parts = nullptr;
    };
    RawList raw_imports, raw_exports;
    void free_lists();

    Zoltan_Struct* zz = nullptr;

    int size() const { return static_cast<int>(weights.size()); }
    ZOLTAN_ID_TYPE gid_word(int object, int word) const;
    ZOLTAN_ID_TYPE lid_word(int object, int word) const;
};

/// Points of all ranks over the same square, so that every rank sends to and gets from every other.
void scatter_points(Program& program, int count);

/// A program with such points and settings.
struct Scattered : Program {
    explicit Scattered(int count,
                       std::initializer_list<std::pair<const char*, std::string>> settings = {}) {
        scatter_points(*this, count);
        set(settings);
    }
};

/// Sets LB_METHOD to HIER with one level, in which every rank has a part of its own; Zoltan makes
/// the handle for it, which gets `inner_method` (a literal).
void use_hier(Program& program, const char* inner_method);

/// Partitions again and again.
void repeat(Program& program, int times);

/// Returns the contents of a handle. Inline, because an older Zoltan lacks the functions.
inline std::vector<char> bytes_of(const Zoltan_Struct* zz) {
    std::vector<char> bytes(Zoltan_Serialize_Size(zz));
    EXPECT_EQ(Zoltan_Serialize(zz, bytes.size(), bytes.data()), ZOLTAN_OK);
    return bytes;
}

/// Gives a handle such contents; returns Zoltan's code.
inline int unpack(Zoltan_Struct* zz, std::vector<char> bytes) {
    return Zoltan_Deserialize(zz, bytes.size(), bytes.data());
}

/// Lets Zoltan migrate objects, which it then counts.
void count_migration(Zoltan_Struct* handle, Migration& migration);

/// Whether values differ on any rank. Collective.
bool differ_somewhere(const std::vector<int>& a, const std::vector<int>& b);

/// Part of each object in the program's order, which is not that of Zoltan's list, after a call
/// with RETURN_LISTS=PARTS.
std::vector<int> parts_by_object(const Outcome& outcome);

/// Largest weight over mean weight of the parts after a call with RETURN_LISTS=PARTS.
double imbalance(const Program& program, const Outcome& outcome, int num_parts);

}  // namespace rrcb::zoltan_test
