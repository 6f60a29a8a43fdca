// zoltan_cpp_client METHOD: a program of Zoltan's C++ interface; every rank begins with some of the
// points of a square, and the parts must end up with equally many.
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <zoltan_cpp.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

namespace {

struct Cloud {
    std::vector<double> positions;
    int size() const { return static_cast<int>(positions.size() / 2); }
};

Cloud cloud_of(int rank) {
    std::mt19937 random(static_cast<unsigned>(rank + 1));
    std::uniform_real_distribution<double> uniform(0, 1);
    Cloud cloud;
    for (int i = 0; i < 1000 * (rank + 1); ++i) {
        cloud.positions.push_back(uniform(random));
        cloud.positions.push_back(uniform(random) * uniform(random));
    }
    return cloud;
}

int count(void* data, int* code) {
    *code = ZOLTAN_OK;
    return static_cast<Cloud*>(data)->size();
}

void list(void* data, int, int, ZOLTAN_ID_PTR global_ids, ZOLTAN_ID_PTR local_ids, int, float*,
          int* code) {
    *code = ZOLTAN_OK;
    for (int i = 0; i < static_cast<Cloud*>(data)->size(); ++i)
        global_ids[i] = local_ids[i] = static_cast<ZOLTAN_ID_TYPE>(i);
}

int dimension(void*, int* code) {
    *code = ZOLTAN_OK;
    return 2;
}

void position(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local_id, double* x, int* code) {
    *code = ZOLTAN_OK;
    std::memcpy(x, &static_cast<Cloud*>(data)->positions[2 * *local_id], 2 * sizeof(double));
}

/// Heaviest part over the mean after a partition; 0 when the call fails.
double imbalance_after(Zoltan& zoltan, const Cloud& cloud) {
    int changes, num_gid, num_lid, num_import, num_export;
    ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;
    int *import_ranks, *import_parts, *export_ranks, *export_parts;
    const int code = zoltan.LB_Partition(changes, num_gid, num_lid, num_import, import_gids,
                                         import_lids, import_ranks, import_parts, num_export,
                                         export_gids, export_lids, export_ranks, export_parts);
    if (code != ZOLTAN_OK) return 0;
    int kept = cloud.size() - num_export + num_import;
    int largest = 0, total = 0, num_ranks = 1;
    MPI_Allreduce(&kept, &largest, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(&kept, &total, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    Zoltan::LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
    Zoltan::LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
    return static_cast<double>(largest) * num_ranks / total;
}

bool run(const char* method) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    Cloud cloud = cloud_of(rank);
    Zoltan zoltan(MPI_COMM_WORLD);
    zoltan.Set_Param("DEBUG_LEVEL", "0");
    if (zoltan.Set_Param("LB_METHOD", method) != ZOLTAN_OK) return false;
    zoltan.Set_Num_Obj_Fn(count, &cloud);
    zoltan.Set_Obj_List_Fn(list, &cloud);
    zoltan.Set_Num_Geom_Fn(dimension, &cloud);
    zoltan.Set_Geom_Fn(position, &cloud);
    Zoltan copy(zoltan);
    const double imbalance = imbalance_after(zoltan, cloud);
    const double again = imbalance_after(copy, cloud);
    if (rank == 0) std::printf("%s: imbalance %.4f, of a copy %.4f\n", method, imbalance, again);
    return imbalance >= 1 && imbalance < 1.02 && again == imbalance;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    float version = 0;
    Zoltan_Initialize(argc, argv, &version);
    const bool passed = RRCB_Zoltan_Active() == 1 && run(argc > 1 ? argv[1] : "RRCB");
    MPI_Finalize();
    return passed ? 0 : 1;
}
