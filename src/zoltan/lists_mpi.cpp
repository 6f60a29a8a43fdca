#include "lists_mpi.hpp"

namespace rrcb::zoltan {

List invert(Zoltan_Struct* zz, const List& exports) {
    List imports;
    ZOLTAN_ID_PTR global_ids = nullptr;
    ZOLTAN_ID_PTR local_ids = nullptr;
    int* ranks = nullptr;
    int* parts = nullptr;
    const int code = Zoltan_Invert_Lists(
        zz, exports.count, exports.global_ids.get(), exports.local_ids.get(), exports.ranks.get(),
        exports.parts.get(), &imports.count, &global_ids, &local_ids, &ranks, &parts);
    imports.global_ids = ZoltanArray<ZOLTAN_ID_TYPE>(global_ids);
    imports.local_ids = ZoltanArray<ZOLTAN_ID_TYPE>(local_ids);
    imports.ranks = ZoltanArray<int>(ranks);
    imports.parts = ZoltanArray<int>(parts);
    if (code == ZOLTAN_OK || code == ZOLTAN_WARN) return imports;
    throw Failure(code, "Zoltan_Invert_Lists failed on the export lists");
}

}  // namespace rrcb::zoltan
