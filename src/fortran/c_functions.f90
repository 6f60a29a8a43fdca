!> Functions of the library in C other than those of a balancer, only for the other modules.
module rrcb_c_functions
  use, intrinsic :: iso_c_binding
  use rrcb_types
  implicit none

  type, bind(c) :: c_ghost_options
    real(c_double) :: radius = -1                           !< not given
    type(c_ptr) :: radii = c_null_ptr
    type(c_ptr) :: lower = c_null_ptr, upper = c_null_ptr, ranks_of_parts = c_null_ptr
  end type

  type, bind(c) :: c_ghost_plan
    integer(c_size_t) :: num_points = 0, num_ghosts = 0, num_send_ranks = 0
    type(c_ptr) :: send = c_null_ptr
    integer(c_size_t) :: num_sent = 0
    type(c_ptr) :: send_indices = c_null_ptr
    integer(c_size_t) :: num_receive_ranks = 0
    type(c_ptr) :: receive = c_null_ptr, shifts = c_null_ptr
  end type

  type, bind(c) :: c_rank_count
    integer(c_int) :: rank = 0
    integer(c_size_t) :: count = 0
  end type

  interface
    type(c_ptr) function c_version() bind(c, name="rrcb_version")
      import
    end function
    type(c_ptr) function c_build_info() bind(c, name="rrcb_build_info")
      import
    end function
    type(c_ptr) function c_last_error() bind(c, name="rrcb_last_error")
      import
    end function
    function c_strlen(text) bind(c, name="strlen")
      import
      type(c_ptr), value :: text
      integer(c_size_t) :: c_strlen
    end function
    integer(c_int) function c_bounding_box(points, lower, upper) bind(c, name="rrcb_bounding_box")
      import
      type(rrcb_points), intent(in) :: points
      real(c_double), intent(inout) :: lower(3), upper(3)
    end function
    integer(c_int) function c_ranks_of_part(part, num_parts, num_ranks, ranks) &
      bind(c, name="rrcb_ranks_of_part")
      import
      integer(c_int32_t), value :: part
      integer(c_int), value :: num_parts, num_ranks
      type(rrcb_rank_range), intent(inout) :: ranks
    end function
    integer(c_int) function c_imbalance(num_parts, part_weights, part_sizes, imbalance) &
      bind(c, name="rrcb_imbalance")
      import
      integer(c_size_t), value :: num_parts
      real(c_double), intent(in) :: part_weights(*)
      type(c_ptr), value :: part_sizes
      real(c_double), intent(inout) :: imbalance
    end function
    integer(c_int) function c_load_unbalance_percent(num_parts, part_weights, part_sizes, percent) &
      bind(c, name="rrcb_load_unbalance_percent")
      import
      integer(c_size_t), value :: num_parts
      real(c_double), intent(in) :: part_weights(*)
      type(c_ptr), value :: part_sizes
      real(c_double), intent(inout) :: percent(*)
    end function
    integer(c_int) function c_worst_load_unbalance_percent(num_parts, part_weights, part_sizes, percent) &
      bind(c, name="rrcb_worst_load_unbalance_percent")
      import
      integer(c_size_t), value :: num_parts
      real(c_double), intent(in) :: part_weights(*)
      type(c_ptr), value :: part_sizes
      real(c_double), intent(inout) :: percent
    end function
    integer(c_int) function c_ghosts_create(balancer, points, options, handle) &
      bind(c, name="rrcb_ghosts_create")
      import
      type(c_ptr), value :: balancer
      type(rrcb_points), intent(in) :: points
      type(c_ghost_options), intent(in) :: options
      type(c_ptr), intent(inout) :: handle
    end function
    subroutine c_ghosts_destroy(handle) bind(c, name="rrcb_ghosts_destroy")
      import
      type(c_ptr), value :: handle
    end subroutine
    integer(c_int) function c_ghosts_get_plan(handle, plan) bind(c, name="rrcb_ghosts_get_plan")
      import
      type(c_ptr), value :: handle
      type(c_ghost_plan), intent(inout) :: plan
    end function
    integer(c_int) function c_ghosts_fetch(handle, num_columns, columns, limits, report) &
      bind(c, name="rrcb_ghosts_fetch")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
      integer(c_size_t), intent(in), optional :: limits
      type(rrcb_transfer_report), intent(inout), optional :: report
    end function
    integer(c_int) function c_ghosts_accumulate(handle, num_columns, columns, limits, report) &
      bind(c, name="rrcb_ghosts_accumulate")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
      integer(c_size_t), intent(in), optional :: limits
      type(rrcb_transfer_report), intent(inout), optional :: report
    end function
    integer(c_int) function c_ghosts_apply_shifts(handle, type, length, positions) &
      bind(c, name="rrcb_ghosts_apply_shifts")
      import
      type(c_ptr), value :: handle
      integer(c_int), value :: type
      integer(c_size_t), value :: length
      type(*), intent(inout) :: positions(*)
    end function
    integer(c_int) function c_groups_create(balancer, points, keys, place, handle) &
      bind(c, name="rrcb_groups_create")
      import
      type(c_ptr), value :: balancer, keys
      type(rrcb_points), intent(in) :: points
      integer(c_int), value :: place
      type(c_ptr), intent(inout) :: handle
    end function
    subroutine c_groups_destroy(handle) bind(c, name="rrcb_groups_destroy")
      import
      type(c_ptr), value :: handle
    end subroutine
    integer(c_int) function c_groups_points(handle, points) bind(c, name="rrcb_groups_points")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(inout) :: points
    end function
    integer(c_int) function c_groups_fetch(handle, num_columns, columns, limits, report) &
      bind(c, name="rrcb_groups_fetch")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
      integer(c_size_t), intent(in), optional :: limits
      type(rrcb_transfer_report), intent(inout), optional :: report
    end function
    integer(c_int) function c_groups_sums(handle, components, values, sums) &
      bind(c, name="rrcb_groups_sums")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: components
      type(c_ptr), value :: values, sums
    end function
    integer(c_int) function c_controller_create(comm, handle) bind(c, name="rrcb_controller_create_fortran")
      import
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: handle
    end function
    subroutine c_controller_destroy(handle) bind(c, name="rrcb_controller_destroy")
      import
      type(c_ptr), value :: handle
    end subroutine
    integer(c_int) function c_controller_step(handle, load, due) bind(c, name="rrcb_controller_step")
      import
      type(c_ptr), value :: handle
      real(c_double), value :: load
      integer(c_int), intent(inout) :: due
    end function
    integer(c_int) function c_controller_step_points(handle, load, points, due) &
      bind(c, name="rrcb_controller_step_points")
      import
      type(c_ptr), value :: handle
      real(c_double), value :: load, points
      integer(c_int), intent(inout) :: due
    end function
    integer(c_int) function c_controller_due(handle, due) bind(c, name="rrcb_controller_due")
      import
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: due
    end function
    integer(c_int) function c_controller_rebalanced(handle, report, cost) &
      bind(c, name="rrcb_controller_rebalanced")
      import
      type(c_ptr), value :: handle
      type(rrcb_report), intent(in), optional :: report
      real(c_double), value :: cost
    end function
    integer(c_int) function c_cost_model_create(comm, controller, num_columns, handle) &
      bind(c, name="rrcb_cost_model_create_fortran")
      import
      integer(c_int), value :: comm, num_columns
      type(c_ptr), intent(in), optional :: controller
      type(c_ptr), intent(inout) :: handle
    end function
    subroutine c_cost_model_destroy(handle) bind(c, name="rrcb_cost_model_destroy")
      import
      type(c_ptr), value :: handle
    end subroutine
    integer(c_int) function c_cost_model_step(handle, seconds, num_columns, columns) &
      bind(c, name="rrcb_cost_model_step")
      import
      type(c_ptr), value :: handle
      real(c_double), value :: seconds
      integer(c_size_t), value :: num_columns
      real(c_double), intent(in) :: columns(*)
    end function
    integer(c_int) function c_cost_model_weights(handle, count, num_columns, columns, weights) &
      bind(c, name="rrcb_cost_model_weights")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count, num_columns
      real(c_double), intent(in) :: columns(*)
      type(c_ptr), value :: weights
    end function
    integer(c_int) function c_cost_model_costs(handle, num_columns, costs) &
      bind(c, name="rrcb_cost_model_costs")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      real(c_double), intent(inout) :: costs(*)
    end function
    integer(c_int) function c_cost_model_uses_costs(handle, uses_costs) &
      bind(c, name="rrcb_cost_model_uses_costs")
      import
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: uses_costs
    end function
    type(c_ptr) function c_cost_model_report(handle) bind(c, name="rrcb_cost_model_report")
      import
      type(c_ptr), value :: handle
    end function
  end interface

end module rrcb_c_functions
