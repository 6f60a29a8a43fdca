!> The functions of rrcb/rrcb.h and their types, for the module rrcb alone.
module rrcb_c
  use, intrinsic :: iso_c_binding
  implicit none

  !> One cut, as rrcb_cut.
  type, bind(c) :: rrcb_cut
    integer(c_int32_t) :: axis = 0, divides = 0
    real(c_double) :: at(3) = 0
  end type

  !> Of the last balance, as rrcb_report.
  type, bind(c) :: rrcb_report
    real(c_double) :: imbalance = 1
    integer(c_int) :: within_tolerance = 0, kept = 0
    integer(c_int64_t) :: num_points = 0
    real(c_double) :: total_weight = 0, least_imbalance = 1
    integer(c_int) :: rounds = 0
  end type

  type, bind(c) :: c_cuts
    integer(c_int) :: dimension = 0, num_parts = 1
    type(c_ptr) :: tree = c_null_ptr
    integer(c_int) :: group_size = 1, larger_below = 0
  end type

  type, bind(c) :: c_plan
    integer(c_size_t) :: num_points = 0, num_points_after = 0, num_exports = 0
    type(c_ptr) :: export_indices = c_null_ptr, export_ranks = c_null_ptr, &
      export_parts = c_null_ptr
    integer(c_size_t) :: num_imports = 0
    type(c_ptr) :: import_ranks = c_null_ptr, import_indices = c_null_ptr, &
      import_parts = c_null_ptr
  end type

  interface
    function c_version() bind(c, name="rrcb_version")
      import :: c_ptr
      type(c_ptr) :: c_version
    end function
    function c_build_info() bind(c, name="rrcb_build_info")
      import :: c_ptr
      type(c_ptr) :: c_build_info
    end function
    function c_last_error() bind(c, name="rrcb_last_error")
      import :: c_ptr
      type(c_ptr) :: c_last_error
    end function
    function c_strlen(text) bind(c, name="strlen")
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: c_strlen
    end function
    function c_create(comm, handle) bind(c, name="rrcb_create_fortran") result(code)
      import :: c_int, c_ptr
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: handle
      integer(c_int) :: code
    end function
    subroutine c_free(handle) bind(c, name="rrcb_free")
      import :: c_ptr
      type(c_ptr), value :: handle
    end subroutine
    function c_set(handle, option, value) bind(c, name="rrcb_set") result(code)
      import :: c_char, c_int, c_ptr
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: option(*), value(*)
      integer(c_int) :: code
    end function
    function c_set_part_sizes(handle, count, sizes) bind(c, name="rrcb_set_part_sizes") result(code)
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: sizes(*)
      integer(c_int) :: code
    end function
    function c_balance(handle, dimension, count, coordinates, weights, parts) &
      bind(c, name="rrcb_balance") result(code)
      import :: c_double, c_int, c_int32_t, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: dimension
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: weights
      integer(c_int32_t), intent(out) :: parts(*)
      integer(c_int) :: code
    end function
    function c_rebalance(handle, dimension, count, coordinates, weights, parts) &
      bind(c, name="rrcb_rebalance") result(code)
      import :: c_double, c_int, c_int32_t, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: dimension
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: weights
      integer(c_int32_t), intent(out) :: parts(*)
      integer(c_int) :: code
    end function
    function c_get_report(handle, report) bind(c, name="rrcb_get_report") result(code)
      import :: c_int, c_ptr, rrcb_report
      type(c_ptr), value :: handle
      type(rrcb_report), intent(inout) :: report
      integer(c_int) :: code
    end function
    function c_get_cuts(handle, cuts) bind(c, name="rrcb_get_cuts") result(code)
      import :: c_cuts, c_int, c_ptr
      type(c_ptr), value :: handle
      type(c_cuts), intent(inout) :: cuts
      integer(c_int) :: code
    end function
    function c_gather_cuts(handle) bind(c, name="rrcb_gather_cuts") result(code)
      import :: c_int, c_ptr
      type(c_ptr), value :: handle
      integer(c_int) :: code
    end function
    function c_set_cuts(handle, cuts) bind(c, name="rrcb_set_cuts") result(code)
      import :: c_cuts, c_int, c_ptr
      type(c_ptr), value :: handle
      type(c_cuts), intent(in) :: cuts
      integer(c_int) :: code
    end function
    function c_assign(handle, count, coordinates, parts) bind(c, name="rrcb_assign") result(code)
      import :: c_double, c_int, c_int32_t, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int32_t), intent(out) :: parts(*)
      integer(c_int) :: code
    end function
    function c_assign_all(handle, count, coordinates, parts) &
      bind(c, name="rrcb_assign_all") result(code)
      import :: c_double, c_int, c_int32_t, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int32_t), intent(out) :: parts(*)
      integer(c_int) :: code
    end function
    function c_box_of(handle, part, lower, upper) bind(c, name="rrcb_box_of") result(code)
      import :: c_double, c_int, c_int32_t, c_ptr
      type(c_ptr), value :: handle
      integer(c_int32_t), value :: part
      real(c_double), intent(out) :: lower(3), upper(3)
      integer(c_int) :: code
    end function
    function c_make_plan(handle, count, parts) bind(c, name="rrcb_make_plan") result(code)
      import :: c_int, c_int32_t, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      integer(c_int32_t), intent(in) :: parts(*)
      integer(c_int) :: code
    end function
    function c_get_plan(handle, plan) bind(c, name="rrcb_get_plan") result(code)
      import :: c_int, c_plan, c_ptr
      type(c_ptr), value :: handle
      type(c_plan), intent(inout) :: plan
      integer(c_int) :: code
    end function
    function c_transfer(handle, bytes, from, to) bind(c, name="rrcb_transfer") result(code)
      import :: c_int, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: bytes
      type(c_ptr), value :: from, to
      integer(c_int) :: code
    end function
    function c_controller_create(comm, handle) bind(c, name="rrcb_controller_create_fortran") &
      result(code)
      import :: c_int, c_ptr
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: handle
      integer(c_int) :: code
    end function
    subroutine c_controller_destroy(handle) bind(c, name="rrcb_controller_destroy")
      import :: c_ptr
      type(c_ptr), value :: handle
    end subroutine
    function c_controller_step(handle, load, due) bind(c, name="rrcb_controller_step") result(code)
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: handle
      real(c_double), value :: load
      integer(c_int), intent(inout) :: due
      integer(c_int) :: code
    end function
    function c_controller_step_points(handle, load, points, due) &
      bind(c, name="rrcb_controller_step_points") result(code)
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: handle
      real(c_double), value :: load, points
      integer(c_int), intent(inout) :: due
      integer(c_int) :: code
    end function
    function c_controller_due(handle, due) bind(c, name="rrcb_controller_due") result(code)
      import :: c_int, c_ptr
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: due
      integer(c_int) :: code
    end function
    function c_controller_rebalanced(handle, report, cost) &
      bind(c, name="rrcb_controller_rebalanced") result(code)
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: handle, report
      real(c_double), value :: cost
      integer(c_int) :: code
    end function
    function c_cost_model_create(comm, controller, num_columns, handle) &
      bind(c, name="rrcb_cost_model_create_fortran") result(code)
      import :: c_int, c_ptr
      integer(c_int), value :: comm, num_columns
      type(c_ptr), value :: controller
      type(c_ptr), intent(inout) :: handle
      integer(c_int) :: code
    end function
    subroutine c_cost_model_destroy(handle) bind(c, name="rrcb_cost_model_destroy")
      import :: c_ptr
      type(c_ptr), value :: handle
    end subroutine
    function c_cost_model_step(handle, seconds, num_columns, columns) &
      bind(c, name="rrcb_cost_model_step") result(code)
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: handle
      real(c_double), value :: seconds
      integer(c_size_t), value :: num_columns
      real(c_double), intent(in) :: columns(*)
      integer(c_int) :: code
    end function
    function c_cost_model_weights(handle, count, num_columns, columns, weights) &
      bind(c, name="rrcb_cost_model_weights") result(code)
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count, num_columns
      real(c_double), intent(in) :: columns(*)
      real(c_double), intent(out) :: weights(*)
      integer(c_int) :: code
    end function
    function c_cost_model_costs(handle, costs) bind(c, name="rrcb_cost_model_costs") result(code)
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: handle
      real(c_double), intent(inout) :: costs(*)
      integer(c_int) :: code
    end function
    function c_cost_model_uses_costs(handle, uses_costs) &
      bind(c, name="rrcb_cost_model_uses_costs") result(code)
      import :: c_int, c_ptr
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: uses_costs
      integer(c_int) :: code
    end function
    function c_cost_model_report(handle) bind(c, name="rrcb_cost_model_report") result(text)
      import :: c_ptr
      type(c_ptr), value :: handle
      type(c_ptr) :: text
    end function
  end interface

end module rrcb_c
