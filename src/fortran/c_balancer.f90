!> Functions of a balancer in C, only for the module rrcb_balancers.
module rrcb_c_balancer
  use, intrinsic :: iso_c_binding
  use rrcb_types
  implicit none

  type, bind(c) :: c_cuts
    integer(c_int) :: dimension = 0, num_parts = 1
    type(c_ptr) :: tree = c_null_ptr
    integer(c_int) :: group_size = 1, larger_below = 0, dealt = 0
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
    integer(c_int) function c_create(comm, handle) bind(c, name="rrcb_create_fortran")
      import
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: handle
    end function
    subroutine c_destroy(handle) bind(c, name="rrcb_destroy")
      import
      type(c_ptr), value :: handle
    end subroutine
    integer(c_int) function c_set(handle, option, value) bind(c, name="rrcb_set")
      import
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: option(*), value(*)
    end function
    integer(c_int) function c_set_part_sizes(handle, count, sizes) bind(c, name="rrcb_set_part_sizes")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: sizes(*)
    end function
    integer(c_int) function c_balance(handle, points, parts) bind(c, name="rrcb_balance")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
    end function
    integer(c_int) function c_rebalance(handle, points, parts) bind(c, name="rrcb_rebalance")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
    end function
    integer(c_int) function c_assign(handle, points, parts) bind(c, name="rrcb_assign")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
    end function
    integer(c_int) function c_assign_all(handle, points, parts) bind(c, name="rrcb_assign_all")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
    end function
    integer(c_int) function c_release_buffers(handle) bind(c, name="rrcb_release_buffers")
      import
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_gather_cuts(handle) bind(c, name="rrcb_gather_cuts")
      import
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_get_report(handle, report) bind(c, name="rrcb_get_report")
      import
      type(c_ptr), value :: handle
      type(rrcb_report), intent(inout) :: report
    end function
    integer(c_int) function c_get_cuts(handle, cuts) bind(c, name="rrcb_get_cuts")
      import
      type(c_ptr), value :: handle
      type(c_cuts), intent(inout) :: cuts
    end function
    integer(c_int) function c_set_cuts(handle, cuts) bind(c, name="rrcb_set_cuts")
      import
      type(c_ptr), value :: handle
      type(c_cuts), intent(in) :: cuts
    end function
    integer(c_int) function c_part_of(handle, position, part) bind(c, name="rrcb_part_of")
      import
      type(c_ptr), value :: handle
      real(c_double), intent(in) :: position(3)
      integer(c_int32_t), intent(inout) :: part
    end function
    integer(c_int) function c_box_of(handle, part, lower, upper) bind(c, name="rrcb_box_of")
      import
      type(c_ptr), value :: handle
      integer(c_int32_t), value :: part
      real(c_double), intent(inout) :: lower(3), upper(3)
    end function
    integer(c_int) function c_parts_touching(handle, lower, upper, capacity, parts, count) &
      bind(c, name="rrcb_parts_touching")
      import
      type(c_ptr), value :: handle
      real(c_double), intent(in) :: lower(3), upper(3)
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout) :: parts(*)
      integer(c_size_t), intent(inout) :: count
    end function
    integer(c_int) function c_make_plan(handle, count, parts) bind(c, name="rrcb_make_plan")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      integer(c_int32_t), intent(in) :: parts(*)
    end function
    integer(c_int) function c_get_plan(handle, plan) bind(c, name="rrcb_get_plan")
      import
      type(c_ptr), value :: handle
      type(c_plan), intent(inout) :: plan
    end function
    integer(c_int) function c_transfer(handle, num_columns, columns, limits, report) &
      bind(c, name="rrcb_transfer")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
      integer(c_size_t), intent(in), optional :: limits
      type(rrcb_transfer_report), intent(inout), optional :: report
    end function
    integer(c_int) function c_remap(handle, count, parts, previous, ranks_of_parts, num_parts, &
                                    numbers, kept) bind(c, name="rrcb_remap")
      import
      type(c_ptr), value :: handle, parts
      integer(c_size_t), value :: count, num_parts
      integer(c_int32_t), intent(in), optional :: previous(*)
      type(rrcb_rank_range), intent(in), optional :: ranks_of_parts(*)
      integer(c_int32_t), intent(inout) :: numbers(*)
      type(rrcb_kept), intent(inout), optional :: kept
    end function
    integer(c_int) function c_part_weights(handle, points, parts, num_parts, part_weights) &
      bind(c, name="rrcb_part_weights")
      import
      type(c_ptr), value :: handle, parts
      type(rrcb_points), intent(in) :: points
      integer(c_size_t), value :: num_parts
      real(c_double), intent(inout) :: part_weights(*)
    end function
    integer(c_int) function c_moved_fraction(handle, points, parts, fraction) &
      bind(c, name="rrcb_moved_fraction")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
      real(c_double), intent(inout) :: fraction
    end function
  end interface

end module rrcb_c_balancer
