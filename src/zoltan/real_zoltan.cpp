#include "real_zoltan.hpp"

#include "message.hpp"

#include <dlfcn.h>

namespace rrcb::zoltan {

namespace {

class Finder {
  public:
    template <typename Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
        if (function == nullptr) missing_ = name;
    }
    const char* missing() const { return missing_; }

  private:
    const char* missing_ = nullptr;
};

Finder find_all(RealZoltan& real) {
    Finder finder;
    finder.find(real.create, "Zoltan_Create");
    finder.find(real.copy, "Zoltan_Copy");
    finder.find(real.copy_to, "Zoltan_Copy_To");
    finder.find(real.destroy, "Zoltan_Destroy");
    finder.find(real.set_param_vec, "Zoltan_Set_Param_Vec");
    finder.find(real.lb_partition, "Zoltan_LB_Partition");
    finder.find(real.lb_balance, "Zoltan_LB_Balance");
    finder.find(real.lb_set_part_sizes, "Zoltan_LB_Set_Part_Sizes");
    finder.find(real.lb_point_pp_assign, "Zoltan_LB_Point_PP_Assign");
    finder.find(real.lb_point_assign, "Zoltan_LB_Point_Assign");
    finder.find(real.lb_box_pp_assign, "Zoltan_LB_Box_PP_Assign");
    finder.find(real.lb_box_assign, "Zoltan_LB_Box_Assign");
    finder.find(real.rcb_box, "Zoltan_RCB_Box");
    finder.find(real.rcb_partition_tree, "Zoltan_RCB_Partition_Tree");
    finder.find(real.serialize_size, "Zoltan_Serialize_Size");
    finder.find(real.serialize, "Zoltan_Serialize");
    finder.find(real.deserialize, "Zoltan_Deserialize");
    return finder;
}

}  // namespace

const RealZoltan* real_zoltan() noexcept {
    static RealZoltan real;
    static const Finder finder = find_all(real);
    if (finder.missing() == nullptr) return &real;
    print_error(-1, finder.missing(),
                "the real function is not found; load or link libtrilinos_zoltan behind "
                "librrcb_zoltan");
    return nullptr;
}

}  // namespace rrcb::zoltan
