! The loop of examples/loop in Fortran: the same numbers on as many ranks.
program loop
  use, intrinsic :: iso_c_binding
  use mpi_f08
  use rrcb
  implicit none

  integer, parameter :: dp = c_double, cells_per_axis = 101
  real(dp), parameter :: radius = 0.01_dp, cost = 100000
  type(rrcb_balancer) :: balancer
  type(rrcb_controller) :: controller
  type(rrcb_cost_model) :: model
  type(rrcb_ghosts) :: ghosts
  type(rrcb_plan) :: plan
  type(rrcb_ghost_plan) :: near
  type(rrcb_report) :: report
  real(dp), allocatable, target :: positions(:, :), moved(:, :), fetched(:, :), weights(:)
  real(dp), allocatable :: columns(:, :)
  integer(c_int32_t), allocatable :: parts(:)
  real(dp) :: load, all_loads, heaviest_load, heaviest, total
  integer :: rank, num_ranks, error, step, rebalances

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, num_ranks)
  positions = strip_of(rank, num_ranks)
  allocate (columns(2, size(positions, 2)))
  columns = 0
  heaviest = 0
  total = 0
  rebalances = 0
  call balancer%create(MPI_COMM_WORLD, error); call check(error)
  call controller%create(MPI_COMM_WORLD, error); call check(error)
  call model%create(MPI_COMM_WORLD, 2, error, controller); call check(error)
  do step = 1, 100
    allocate (parts(size(positions, 2)), weights(size(positions, 2)))
    if (step == 1 .or. controller%due()) then
      call model%weights(columns, weights, error); call check(error)
      call balancer%balance(rrcb_interleaved_points(positions, weights), parts, error); call check(error)
      call balancer%get_report(report, error); call check(error)
      call controller%rebalanced(cost, error, report); call check(error)
      rebalances = rebalances + 1
    else
      call balancer%assign_all(rrcb_interleaved_points(positions), parts, error); call check(error)
    end if
    call balancer%make_plan(parts, error); call check(error)
    call balancer%get_plan(plan, error); call check(error)
    allocate (moved(2, plan%num_points_after))
    call balancer%transfer([rrcb_column(positions, moved)], error); call check(error)
    call move_alloc(moved, positions)
    deallocate (parts, weights)

    call ghosts%create(balancer, rrcb_interleaved_points(positions), error, radius); call check(error)
    call ghosts%get_plan(near, error); call check(error)
    allocate (fetched(2, near%num_ghosts))
    call ghosts%fetch([rrcb_column(positions, fetched)], error); call check(error)
    call ghosts%destroy()
    columns = rows_of(count_neighbours(positions, fetched))
    deallocate (fetched)
    ! All drift to the wall at x = 0, where they crowd.
    positions(1, :) = positions(1, :) - 0.02_dp*positions(1, :)*(1 - positions(1, :))
    load = sum(columns(2, :))
    call model%step(load, [real(size(positions, 2), dp), load], error); call check(error)

    call MPI_Allreduce(load, heaviest_load, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
    call MPI_Allreduce(load, all_loads, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    heaviest = heaviest + heaviest_load
    total = total + all_loads
  end do
  call model%destroy()
  call controller%destroy()
  call balancer%destroy()
  if (rank == 0) then
    print '(i0, a)', nint(total), " pairs of neighbours met in 100 steps"
    print '(i0, a, f11.9)', rebalances, " rebalances, mean imbalance ", heaviest*num_ranks/total
  end if
  call MPI_Finalize()

contains

  ! Ends all ranks if a call fails; an error is the same on each.
  subroutine check(code)
    integer, intent(in) :: code
    if (code == rrcb_ok) return
    print '(a)', rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, code)
  end subroutine

  ! A unit square of 200 x 200 particles, a strip of it on each rank.
  function strip_of(rank, num_ranks) result(strip)
    integer, intent(in) :: rank, num_ranks
    real(dp), allocatable :: strip(:, :)
    integer :: first, i, j
    first = 200*rank/num_ranks
    allocate (strip(2, 200*(200*(rank + 1)/num_ranks - first)))
    do i = 1, size(strip, 2)/200
      do j = 1, 200
        strip(:, 200*(i - 1) + j) = [(first + i - 0.5_dp)/200, (j - 0.5_dp)/200]
      end do
    end do
  end function

  function cell_of(position) result(cell)
    real(dp), intent(in) :: position(2)
    integer :: cell(2)
    cell = 1 + floor(position/radius)
  end function

  ! How many particles, own ones and ghosts, lie within the radius of each own one.
  function count_neighbours(own, others) result(counts)
    real(dp), intent(in) :: own(:, :), others(:, :)
    integer :: counts(size(own, 2))
    real(dp), allocatable :: x(:, :)
    integer, allocatable :: next(:)
    integer :: first(0:cells_per_axis + 1, 0:cells_per_axis + 1), cell(2), i, j, k
    x = reshape([own, others], [2, size(own, 2) + size(others, 2)])
    allocate (next(size(x, 2)))
    first = 0
    do i = 1, size(x, 2)
      cell = cell_of(x(:, i))
      next(i) = first(cell(1), cell(2))
      first(cell(1), cell(2)) = i
    end do
    counts = 0
    do i = 1, size(own, 2)
      do k = 0, 8
        cell = cell_of(x(:, i)) + [k/3 - 1, mod(k, 3) - 1]
        j = first(cell(1), cell(2))
        do while (j > 0)
          if (hypot(x(1, i) - x(1, j), x(2, i) - x(2, j)) <= radius) counts(i) = counts(i) + 1
          j = next(j)
        end do
      end do
    end do
  end function

  ! A row of columns for each particle: 1, its neighbours.
  function rows_of(neighbours) result(rows)
    integer, intent(in) :: neighbours(:)
    real(dp) :: rows(2, size(neighbours))
    rows(1, :) = 1
    rows(2, :) = neighbours
  end function

end program

! Output on 4 ranks:
! 66744352 pairs of neighbours met in 100 steps
! 5 rebalances, mean imbalance 1.089853056
