#include "zoltan/real/real_zoltan.hpp"

namespace rrcb::zoltan {

const RealZoltan* real_zoltan() noexcept {
    static const RealZoltan real{
        .create = Zoltan_Create,
        .copy = Zoltan_Copy,
        .copy_to = Zoltan_Copy_To,
        .destroy = Zoltan_Destroy,
        .set_param_vec = Zoltan_Set_Param_Vec,
        .lb_partition = Zoltan_LB_Partition,
        .lb_balance = Zoltan_LB_Balance,
        .lb_set_part_sizes = Zoltan_LB_Set_Part_Sizes,
        .lb_point_pp_assign = Zoltan_LB_Point_PP_Assign,
        .lb_point_assign = Zoltan_LB_Point_Assign,
        .lb_box_pp_assign = Zoltan_LB_Box_PP_Assign,
        .lb_box_assign = Zoltan_LB_Box_Assign,
        .rcb_box = Zoltan_RCB_Box,
        .rcb_partition_tree = Zoltan_RCB_Partition_Tree,
        .serialize_size = Zoltan_Serialize_Size,
        .serialize = Zoltan_Serialize,
        .deserialize = Zoltan_Deserialize,
        .words_per_id_entry =
            static_cast<std::size_t>(Zoltan_get_global_id_type(nullptr)) / sizeof(std::uint32_t),
    };
    return &real;
}

}  // namespace rrcb::zoltan
