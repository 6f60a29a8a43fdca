! The quick start in Fortran: balances points that are unevenly distributed over the ranks, and
! moves them.
program quick_start
  use, intrinsic :: iso_c_binding
  use mpi_f08
  use rrcb
  implicit none

  type(rrcb_balancer) :: balancer
  type(rrcb_plan_lists) :: plan
  type(rrcb_report) :: report
  real(c_double), allocatable, target :: coordinates(:, :), here(:, :)
  integer(c_int32_t), allocatable :: parts(:)
  integer :: rank, error

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  coordinates = squares_of(rank)
  allocate (parts(size(coordinates, 2)))

  call balancer%create(MPI_COMM_WORLD, error)
  call check(error)
  call balancer%set("imbalance_tolerance", "1.02", error)
  call check(error)
  call balancer%balance(rrcb_interleaved_points(coordinates), parts, error)
  call check(error)
  call balancer%plan(parts, error)
  call check(error)

  call balancer%get_plan(plan, error)
  call check(error)
  allocate (here(2, plan%num_points_after))
  call balancer%transfer([rrcb_column(coordinates, here)], error)
  call check(error)

  call balancer%get_report(report, error)
  call check(error)
  if (rank == 0) then
    print '(i0, a, f6.4)', report%num_points, " points, imbalance ", report%imbalance
    print '(3(a, i0))', "rank 0 sends ", size(plan%export_parts), " points, receives ", &
      size(plan%import_parts), " and holds ", size(here, 2)
  end if
  call balancer%destroy()
  call MPI_Finalize()

contains

  ! Ends all ranks if a call fails. The error is the same on each rank.
  subroutine check(code)
    integer, intent(in) :: code
    if (code == rrcb_ok) return
    print '(a)', rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, code)
  end subroutine

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
! 16000 points, imbalance 1.0000
! rank 0 sends 0 points, receives 2400 and holds 4000
