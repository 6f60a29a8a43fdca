#include "program.hpp"

#include <algorithm>
#include <random>

namespace rrcb::zoltan_test {

namespace {

Program& program_of(void* data, const char* callback, int* code) {
    auto& program = *static_cast<Program*>(data);
    *code = ZOLTAN_OK;
    if (program.fault) program.fault(callback, *code);
    return program;
}

int num_objects(void* data, int* code) {
    Program& program = program_of(data, "NUM_OBJ", code);
    return program.size() + program.count_offset;
}

void write_object(const Program& program, int object, ZOLTAN_ID_PTR gid, ZOLTAN_ID_PTR lid) {
    for (int w = 0; w < program.gid_width; ++w) gid[w] = program.gid_word(object, w);
    for (int w = 0; w < program.lid_width; ++w) lid[w] = program.lid_word(object, w);
}

void list_objects(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR gids, ZOLTAN_ID_PTR lids,
                  int weight_dimension, float* weights, int* code) {
    const Program& program = program_of(data, "OBJ_LIST", code);
    for (int i = 0; i < program.size(); ++i) {
        write_object(program, i, gids + i * num_gid,
                     lids == nullptr ? nullptr : lids + i * num_lid);
        for (int k = 0; k < weight_dimension; ++k) {
            weights[i * weight_dimension + k] = k == 0
                                                    ? program.weights[static_cast<std::size_t>(i)]
                                                    : program.further_weight(i, k);
        }
    }
}

int dimension_of_space(void* data, int* code) {
    return program_of(data, "NUM_GEOM", code).reported_dimension;
}

void list_positions(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int dimension,
                    double* positions, int* code) {
    const Program& program = program_of(data, "GEOM_MULTI", code);
    std::copy_n(program.coordinates.begin(), count * dimension, positions);
}

ListCopy copy_of(const Program::RawList& raw, int num_gid, int num_lid) {
    ListCopy copy;
    copy.count = raw.count;
    copy.has_global_ids = raw.global_ids != nullptr;
    copy.has_local_ids = raw.local_ids != nullptr;
    copy.has_ranks = raw.ranks != nullptr;
    copy.has_parts = raw.parts != nullptr;
    for (int i = 0; i < raw.count; ++i) {
        const auto gid = raw.global_ids + i * num_gid;
        copy.global_ids.emplace_back(gid, gid + num_gid);
        const auto lid = raw.local_ids + (num_lid == 0 ? 0 : i * num_lid);
        copy.local_ids.emplace_back(lid, lid + num_lid);
        copy.ranks.push_back(raw.ranks[i]);
        if (raw.parts != nullptr) copy.parts.push_back(raw.parts[i]);
    }
    return copy;
}

void free_list(Program::RawList& raw) {
    Zoltan_LB_Free_Part(&raw.global_ids, &raw.local_ids, &raw.ranks, &raw.parts);
    raw = {};
}

Outcome finish(Program& program, Outcome outcome) {
    outcome.imports = copy_of(program.raw_imports, outcome.num_gid, outcome.num_lid);
    outcome.exports = copy_of(program.raw_exports, outcome.num_gid, outcome.num_lid);
    if (!program.keep_lists) program.free_lists();
    return outcome;
}

}  // namespace

Program::Program(int dimension_, MPI_Comm comm)
    : dimension(dimension_), reported_dimension(dimension_) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    zz = Zoltan_Create(comm);
    set("DEBUG_LEVEL", "0");
    register_callbacks(zz);
}

Program::~Program() {
    free_lists();
    Zoltan_Destroy(&zz);
}

void Program::add(std::vector<double> position, float weight) {
    coordinates.insert(coordinates.end(), position.begin(), position.end());
    weights.push_back(weight);
}

void Program::register_callbacks(Zoltan_Struct* handle) {
    Zoltan_Set_Num_Obj_Fn(handle, num_objects, this);
    Zoltan_Set_Obj_List_Fn(handle, list_objects, this);
    Zoltan_Set_Num_Geom_Fn(handle, dimension_of_space, this);
    Zoltan_Set_Geom_Multi_Fn(handle, list_positions, this);
}

int Program::set(const char* name, const std::string& value) {
    const std::string word(name);
    if (word == "NUM_GID_ENTRIES") gid_width = std::stoi(value);
    if (word == "NUM_LID_ENTRIES") lid_width = std::stoi(value);
    return Zoltan_Set_Param(zz, name, value.c_str());
}

void Program::set(std::initializer_list<std::pair<const char*, std::string>> settings) {
    for (const auto& [name, value] : settings) set(name, value);
}

void Program::set_size(int part, float size) {
    Zoltan_LB_Set_Part_Sizes(zz, 1, 1, &part, nullptr, &size);
}

Place Program::place_of(const double* position, Zoltan_Struct* handle) const {
    std::vector<double> x(position, position + dimension);
    Place place;
    place.code = Zoltan_LB_Point_PP_Assign(handle == nullptr ? zz : handle, x.data(), &place.rank,
                                           &place.part);
    return place;
}

Outcome Program::partition() {
    return partition(zz);
}

Outcome Program::partition(Zoltan_Struct* handle) {
    Outcome outcome;
    RawList& in = raw_imports;
    RawList& out = raw_exports;
    outcome.code =
        Zoltan_LB_Partition(handle, &outcome.changes, &outcome.num_gid, &outcome.num_lid, &in.count,
                            &in.global_ids, &in.local_ids, &in.ranks, &in.parts, &out.count,
                            &out.global_ids, &out.local_ids, &out.ranks, &out.parts);
    return finish(*this, std::move(outcome));
}

Outcome Program::balance() {
    Outcome outcome;
    RawList& in = raw_imports;
    RawList& out = raw_exports;
    outcome.code = Zoltan_LB_Balance(zz, &outcome.changes, &outcome.num_gid, &outcome.num_lid,
                                     &in.count, &in.global_ids, &in.local_ids, &in.ranks,
                                     &out.count, &out.global_ids, &out.local_ids, &out.ranks);
    return finish(*this, std::move(outcome));
}

void Program::free_lists() {
    free_list(raw_imports);
    free_list(raw_exports);
}

ZOLTAN_ID_TYPE Program::gid_word(int object, int word) const {
    const int words[] = {object, rank, 7 * object + rank};
    // A single word must be unique over the ranks by itself.
    const int number = gid_width == 1 ? 100000 * rank + object : words[word];
    return first_id + static_cast<ZOLTAN_ID_TYPE>(number);
}

ZOLTAN_ID_TYPE Program::lid_word(int object, int word) const {
    return first_id + static_cast<ZOLTAN_ID_TYPE>(word == 0 ? object : 1000 + object);
}

void scatter_points(Program& program, int count) {
    std::mt19937 random(static_cast<unsigned>(17 + program.rank));
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < count; ++i) {
        std::vector<double> position;
        for (int a = 0; a < program.dimension; ++a) position.push_back(uniform(random));
        program.add(position, static_cast<float>(1 + position[0]));
    }
}

std::vector<int> parts_by_object(const Outcome& outcome) {
    std::vector<int> parts(outcome.exports.parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[outcome.exports.local_ids[i][0]] = outcome.exports.parts[i];
    }
    return parts;
}

void use_hier(Program& program, const char* inner_method) {
    static const char* inner = nullptr;
    inner = inner_method;
    ZOLTAN_HIER_NUM_LEVELS_FN* levels = [](void*, int* code) {
        *code = ZOLTAN_OK;
        return 1;
    };
    ZOLTAN_HIER_PART_FN* part = [](void* data, int, int* code) {
        *code = ZOLTAN_OK;
        return static_cast<Program*>(data)->rank;
    };
    ZOLTAN_HIER_METHOD_FN* method = [](void*, int, Zoltan_Struct* zz, int* code) {
        *code = Zoltan_Set_Param(zz, "LB_METHOD", inner);
        Zoltan_Set_Param(zz, "DEBUG_LEVEL", "0");
    };
    Zoltan_Set_Hier_Num_Levels_Fn(program.zz, levels, &program);
    Zoltan_Set_Hier_Part_Fn(program.zz, part, &program);
    Zoltan_Set_Hier_Method_Fn(program.zz, method, &program);
    program.set("LB_METHOD", "HIER");
}

void repeat(Program& program, int times) {
    for (int i = 0; i < times; ++i) program.partition();
}

void count_migration(Zoltan_Struct* handle, Migration& migration) {
    ZOLTAN_OBJ_SIZE_FN* size = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int* code) {
        *code = ZOLTAN_OK;
        return static_cast<int>(sizeof(double));
    };
    ZOLTAN_PACK_OBJ_FN* pack = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int, int,
                                  char*, int* code) {
        *code = ZOLTAN_OK;
        ++static_cast<Migration*>(data)->packed;
    };
    ZOLTAN_UNPACK_OBJ_FN* unpack = [](void* data, int, ZOLTAN_ID_PTR, int, char*, int* code) {
        *code = ZOLTAN_OK;
        ++static_cast<Migration*>(data)->unpacked;
    };
    Zoltan_Set_Obj_Size_Fn(handle, size, nullptr);
    Zoltan_Set_Pack_Obj_Fn(handle, pack, &migration);
    Zoltan_Set_Unpack_Obj_Fn(handle, unpack, &migration);
}

bool differ_somewhere(const std::vector<int>& a, const std::vector<int>& b) {
    int differ = a != b ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &differ, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return differ != 0;
}

double imbalance(const Program& program, const Outcome& outcome, int num_parts) {
    std::vector<double> weights(static_cast<std::size_t>(num_parts), 0.0);
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        weights[static_cast<std::size_t>(parts[i])] += static_cast<double>(program.weights[i]);
    }
    MPI_Allreduce(MPI_IN_PLACE, weights.data(), num_parts, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    double total = 0;
    for (const double weight : weights) total += weight;
    return *std::ranges::max_element(weights) * num_parts / total;
}

}  // namespace rrcb::zoltan_test
