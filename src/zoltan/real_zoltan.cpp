#include "real_zoltan.hpp"

#include <dlfcn.h>

#include <string>

#include "failure.hpp"

namespace rrcb::zoltan {

namespace {

template <typename Function>
void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
    if (function == nullptr) {
        throw Failure(ZOLTAN_FATAL, std::string(name) +
                                        " of the real Zoltan not found; load or link "
                                        "libtrilinos_zoltan behind librrcb_zoltan");
    }
}

RealZoltan find_all() {
    RealZoltan real{};
    find(real.create, "Zoltan_Create");
    find(real.copy, "Zoltan_Copy");
    find(real.copy_to, "Zoltan_Copy_To");
    find(real.destroy, "Zoltan_Destroy");
    find(real.set_param_vec, "Zoltan_Set_Param_Vec");
    find(real.lb_partition, "Zoltan_LB_Partition");
    find(real.lb_balance, "Zoltan_LB_Balance");
    find(real.lb_set_part_sizes, "Zoltan_LB_Set_Part_Sizes");
    find(real.lb_point_pp_assign, "Zoltan_LB_Point_PP_Assign");
    find(real.lb_point_assign, "Zoltan_LB_Point_Assign");
    find(real.lb_box_pp_assign, "Zoltan_LB_Box_PP_Assign");
    find(real.lb_box_assign, "Zoltan_LB_Box_Assign");
    find(real.rcb_box, "Zoltan_RCB_Box");
    find(real.rcb_partition_tree, "Zoltan_RCB_Partition_Tree");
    find(real.serialize_size, "Zoltan_Serialize_Size");
    find(real.serialize, "Zoltan_Serialize");
    find(real.deserialize, "Zoltan_Deserialize");
    return real;
}

}  // namespace

const RealZoltan& real_zoltan() {
    static const RealZoltan real = find_all();
    return real;
}

}  // namespace rrcb::zoltan
