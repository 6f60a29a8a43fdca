!> Functions of the library in C for neighbours, only for the other modules.
module rrcb_c_neighbours
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_types
  implicit none

  interface
    integer(c_int) function c_neighbours_create(balancer, options, handle) &
      bind(c, name="rrcb_neighbours_create")
      import
      type(c_ptr), value :: balancer
      type(c_neighbour_options), intent(in) :: options
      type(c_ptr), value :: handle
    end function
    integer(c_int) function c_neighbours_migrate(handle, positions, num_columns, columns) &
      bind(c, name="rrcb_neighbours_migrate")
      import
      type(c_ptr), value :: handle
      type(rrcb_points), intent(in) :: positions
      integer(c_size_t), value :: num_columns
      type(c_array), intent(inout) :: columns(*)
    end function
    integer(c_int) function c_neighbours_find_ghosts(handle, points, cutoffs) &
      bind(c, name="rrcb_neighbours_find_ghosts")
      import
      type(c_ptr), value :: handle, cutoffs
      type(rrcb_points), intent(in) :: points
    end function
    integer(c_int) function c_neighbours_fetch(handle, num_columns, columns, ghosts) &
      bind(c, name="rrcb_neighbours_fetch")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_ptr), intent(in) :: columns(*)
      type(c_array), intent(inout) :: ghosts(*)
    end function
    integer(c_int) function c_neighbours_accumulate(handle, num_columns, columns) &
      bind(c, name="rrcb_neighbours_accumulate")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), value :: num_columns
      type(c_column), intent(in) :: columns(*)
    end function
    integer(c_int) function c_neighbours_sum(handle, shared, num_entries, num_columns, columns) &
      bind(c, name="rrcb_neighbours_sum")
      import
      type(c_ptr), value :: handle
      type(c_shared_entries), intent(in) :: shared
      integer(c_size_t), value :: num_entries, num_columns
      type(c_column), intent(in) :: columns(*)
    end function
    integer(c_int) function c_neighbours_ghost_plan(handle, plan) bind(c, name="rrcb_neighbours_ghost_plan")
      import
      type(c_ptr), value :: handle
      type(c_ghost_plan), intent(inout) :: plan
    end function
    integer(c_int) function c_neighbours_ranks(handle, count, ranks) &
      bind(c, name="rrcb_neighbours_ranks")
      import
      type(c_ptr), value :: handle
      integer(c_size_t), intent(out) :: count
      type(c_ptr), intent(out) :: ranks
    end function
  end interface
end module rrcb_c_neighbours
