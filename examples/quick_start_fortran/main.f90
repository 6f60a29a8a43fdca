! The quick start in Fortran: balances points that are unevenly distributed over the ranks, moves
! them, and fetches copies of the points near each rank's box. A call that fails prints the error
! and ends the program.
program quick_start
  use, intrinsic :: iso_c_binding
  use mpi_f08
  use rrcb
  implicit none

  type(rrcb_balancer) :: balancer
  type(rrcb_plan_lists) :: plan
  type(rrcb_ghosts) :: near
  type(rrcb_ghost_plan) :: near_plan
  type(rrcb_report) :: report
  real(c_double), allocatable, target :: coordinates(:, :), here(:, :), ghosts(:, :)
  integer(c_int32_t), allocatable :: parts(:)
  real(c_double) :: moved
  integer :: rank, num_parts

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, num_parts)
  coordinates = squares_of(rank)
  allocate (parts(size(coordinates, 2)))

  call balancer%create(MPI_COMM_WORLD)
  call balancer%balance(rrcb_interleaved_points(coordinates), parts)
  call balancer%plan(parts)
  call balancer%get_plan(plan)

  ! Columns of the points in this rank's box, and copies of others within 0.05 of it.
  allocate (here(2, plan%num_points_after))
  call balancer%transfer([rrcb_column(coordinates, here)])
  call near%create(balancer, rrcb_interleaved_points(here), cutoff=0.05d0)
  call near%get_plan(near_plan)
  allocate (ghosts(2, near_plan%num_ghosts))
  call near%fetch([rrcb_column(here, ghosts)])

  call balancer%moved_fraction(rrcb_interleaved_points(coordinates), parts, moved)
  call balancer%get_report(report)
  if (rank == 0) then
    print '(2(i0, a))', report%num_points, " points in ", num_parts, " parts"
    print '(a, f6.4, a, i0, a)', "imbalance ", report%imbalance, ", moved ", nint(100*moved), " %"
    print '(2(a, i0))', "rank 0 sends ", size(plan%export_parts), " points and receives ", &
      size(plan%import_parts)
    print '(2(a, i0), a)', "it has ", size(here, 2), ", and copies of ", size(ghosts, 2), &
      " near its box"
  end if
  call near%destroy()
  call balancer%destroy()
  call MPI_Finalize()

contains

  ! Returns the points of this rank. Unit squares of 40 x 40 points form a row; rank r has r + 1 of
  ! them, which follow those of rank r - 1.
  function squares_of(rank) result(points)
    integer, intent(in) :: rank
    real(c_double), allocatable :: points(:, :)
    integer :: i, j
    allocate (points(2, 1600*(rank + 1)))
    do i = 0, 40*(rank + 1) - 1
      do j = 0, 39
        points(:, 40*i + j + 1) = [rank*(rank + 1)/2 + (i + 0.5d0)/40, (j + 0.5d0)/40]
      end do
    end do
  end function

end program

! Output on 4 ranks:
! 16000 points in 4 parts
! imbalance 1.0000, moved 50 %
! rank 0 sends 0 points and receives 2400
! it has 4000, and copies of 80 near its box
