!> The library in Fortran 2008. It calls the functions of rrcb/rrcb.h, whose comments are the
!> manual.
!>
!> Every procedure that can fail sets `error` to rrcb_ok or another code; a collective procedure
!> sets the same code on all ranks. Without the argument `error`, an error stops the program with
!> its text. Points, axes and components count from 1, but parts and ranks from 0, as those of MPI
!> do. Arrays of points have the shape (dimension, points). A communicator is the integer of
!> `mpif.h` and `use mpi`, or the type of `use mpi_f08` if MPI has that module.
module rrcb
  use rrcb_types, only: rrcb_ok, rrcb_invalid_argument, rrcb_out_of_memory, rrcb_mpi_error, &
    rrcb_internal_error, rrcb_float, rrcb_double, rrcb_needs_scatter, rrcb_needs_gather, &
    rrcb_needs_symmetric, rrcb_points, rrcb_interleaved_points, &
    rrcb_column_points, rrcb_column, rrcb_cut, rrcb_cuts, rrcb_report, rrcb_plan_lists, rrcb_ghost_plan, rrcb_rank_range, &
    rrcb_transfer_report, rrcb_remap_report
  use rrcb_functions, only: rrcb_version, rrcb_build_info, rrcb_last_error, rrcb_bounding_box, &
    rrcb_ranks_of_part, rrcb_imbalance, rrcb_balanced_sizes
  use rrcb_balancers, only: rrcb_balancer
  use rrcb_ghost_lists, only: rrcb_ghosts
  use rrcb_arrays, only: rrcb_array
  use rrcb_neighbour_lists, only: rrcb_neighbours
  use rrcb_group_lists, only: rrcb_groups
  use rrcb_controllers, only: rrcb_controller
end module rrcb
