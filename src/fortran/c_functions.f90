!> Functions of the library in C, only for the other modules.
module rrcb_c_functions
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_types
  implicit none

  interface
    integer(c_int) function c_prints_last_error() bind(c, name="rrcb_prints_last_error")
      import
    end function
    subroutine c_note_printed_error() bind(c, name="rrcb_note_printed_error")
    end subroutine
  end interface

  abstract interface
    type(c_ptr) function text() bind(c)
      import
    end function
    integer(c_int) function make_of_comm(comm, handle) bind(c)
      import
      integer(c_int), value :: comm
      type(c_ptr), value :: handle
    end function
    subroutine free(handle) bind(c)
      import
      type(c_ptr), intent(inout) :: handle
    end subroutine
    integer(c_int) function divide(handle, points, parts) bind(c)
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: points
      type(c_ptr), value :: parts
    end function
    integer(c_int) function call_of(handle) bind(c)
      import
      type(c_ptr), value :: handle
    end function
    integer(c_int) function move(handle, num_columns, columns, options) bind(c)
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
      type(c_transfer_options), intent(in) :: options
    end function
    integer(c_int) function measure(num_parts, part_weights, part_sizes, result) bind(c)
      import
      integer(c_size_t), value :: num_parts
      type(c_ptr), value :: part_weights, part_sizes
      real(c_double), intent(inout) :: result
    end function
    integer(c_int) function save_state(handle, bytes, length) bind(c)
      import
      type(c_ptr), value :: handle
      type(c_ptr), intent(out) :: bytes
      integer(c_size_t), intent(out) :: length
    end function
    integer(c_int) function shift(handle, positions) bind(c)
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: positions
    end function
    integer(c_int) function ask(handle, answer) bind(c)
      import
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: answer
    end function
  end interface

  procedure(text), bind(c, name="rrcb_version") :: c_version
  procedure(text), bind(c, name="rrcb_build_info") :: c_build_info
  procedure(text), bind(c, name="rrcb_last_error") :: c_last_error
  procedure(make_of_comm), bind(c, name="rrcb_balancer_create_fortran") :: c_create
  procedure(make_of_comm), bind(c, name="rrcb_controller_create_fortran") :: c_controller_create
  procedure(free), bind(c, name="rrcb_balancer_destroy") :: c_destroy
  procedure(free), bind(c, name="rrcb_ghosts_destroy") :: c_ghosts_destroy
  procedure(free), bind(c, name="rrcb_groups_destroy") :: c_groups_destroy
  procedure(free), bind(c, name="rrcb_neighbours_destroy") :: c_neighbours_destroy
  procedure(free), bind(c, name="rrcb_controller_destroy") :: c_controller_destroy
  procedure(free), bind(c, name="rrcb_cost_model_destroy") :: c_cost_model_destroy
  procedure(divide), bind(c, name="rrcb_balance") :: c_balance
  procedure(divide), bind(c, name="rrcb_assign") :: c_assign
  procedure(divide), bind(c, name="rrcb_assign_all") :: c_assign_all
  procedure(call_of), bind(c, name="rrcb_release_buffers") :: c_release_buffers
  procedure(move), bind(c, name="rrcb_transfer") :: c_transfer
  procedure(move), bind(c, name="rrcb_ghosts_fetch") :: c_ghosts_fetch
  procedure(move), bind(c, name="rrcb_ghosts_reply") :: c_ghosts_reply
  procedure(move), bind(c, name="rrcb_ghosts_accumulate") :: c_ghosts_accumulate
  procedure(move), bind(c, name="rrcb_groups_to_points") :: c_groups_to_points
  procedure(shift), bind(c, name="rrcb_ghosts_apply_shifts") :: c_ghosts_apply_shifts
  procedure(shift), bind(c, name="rrcb_neighbours_apply_shifts") :: c_neighbours_apply_shifts
  procedure(measure), bind(c, name="rrcb_imbalance") :: c_imbalance
  procedure(save_state), bind(c, name="rrcb_save_cuts") :: c_save_cuts
  procedure(save_state), bind(c, name="rrcb_controller_save") :: c_controller_save
  procedure(save_state), bind(c, name="rrcb_cost_model_save") :: c_cost_model_save
  procedure(ask), bind(c, name="rrcb_controller_due") :: c_controller_due
  procedure(ask), bind(c, name="rrcb_cost_model_uses_costs") :: c_cost_model_uses_costs
  procedure(ask), bind(c, name="rrcb_cost_model_num_columns") :: c_cost_model_num_columns

  interface
    integer(c_int) function c_balanced_sizes(num_parts, loads, part_sizes, sizes) &
      bind(c, name="rrcb_balanced_sizes")
      import
      integer(c_size_t), value :: num_parts
      type(c_ptr), value :: loads, part_sizes
      real(c_double), intent(inout) :: sizes(*)
    end function
    integer(c_int) function c_set(handle, option, value) bind(c, name="rrcb_balancer_set")
      import
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: option(*), value(*)
    end function
    integer(c_int) function c_set_part_sizes(handle, count, sizes) bind(c, name="rrcb_balancer_set_part_sizes")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: sizes(*)
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
      type(c_ptr), value :: handle, cuts
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
    integer(c_int) function c_make_plan(handle, count, parts) bind(c, name="rrcb_plan")
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
    integer(c_int) function c_remap(handle, count, parts, previous, ranks_of_parts, num_parts, &
                                    numbers, report) bind(c, name="rrcb_remap")
      import
      type(c_ptr), value :: handle, parts
      integer(c_size_t), value :: count, num_parts
      integer(c_int32_t), intent(in), optional :: previous(*)
      type(rrcb_rank_range), intent(in), optional :: ranks_of_parts(*)
      integer(c_int32_t), intent(inout) :: numbers(*)
      type(rrcb_remap_report), intent(inout), optional :: report
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
    integer(c_int) function c_ghosts_create(balancer, points, options, handle) &
      bind(c, name="rrcb_ghosts_create")
      import
      type(c_ptr), value :: balancer
      type(rrcb_points), intent(in) :: points
      type(c_ghost_options), intent(in) :: options
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_ghosts_get_plan(handle, plan) bind(c, name="rrcb_ghosts_get_plan")
      import
      type(c_ptr), value :: handle
      type(c_ghost_plan), intent(inout) :: plan
    end function
    integer(c_int) function c_groups_create(balancer, points, keys, place, handle) &
      bind(c, name="rrcb_groups_create")
      import
      type(c_ptr), value :: balancer, keys
      type(rrcb_points), intent(in) :: points
      integer(c_int), value :: place
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_groups_points(handle, points) bind(c, name="rrcb_groups_points")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(inout) :: points
    end function
    integer(c_int) function c_groups_sums(handle, components, values, sums) &
      bind(c, name="rrcb_groups_sums")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: components
      type(c_ptr), value :: values, sums
    end function
    integer(c_int) function c_controller_step(handle, load, weight, due) &
      bind(c, name="rrcb_controller_step")
      import
      type(c_ptr), value :: handle
      real(c_double), value :: load
      type(c_ptr), value :: weight
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
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_load_cuts(handle, bytes, length) bind(c, name="rrcb_load_cuts")
      import
      type(c_ptr), value :: handle
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: length
    end function
    integer(c_int) function c_controller_load(comm, bytes, length, handle) &
      bind(c, name="rrcb_controller_load_fortran")
      import
      integer(c_int), value :: comm
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: length
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_cost_model_load(comm, controller, bytes, length, handle) &
      bind(c, name="rrcb_cost_model_load_fortran")
      import
      integer(c_int), value :: comm
      type(c_ptr), intent(in), optional :: controller
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: length
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_join_keys(handle, count, keys_per_point, keys, joined) &
      bind(c, name="rrcb_join_keys")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: count, keys_per_point
      type(c_ptr), value :: keys, joined
    end function
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
    type(c_ptr) function c_cost_model_report(handle) bind(c, name="rrcb_cost_model_report")
      import
      type(c_ptr), value :: handle
    end function
  end interface

end module rrcb_c_functions
