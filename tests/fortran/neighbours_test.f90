! Steps of 600 points in a periodic square, with neighbours and by the collective procedures.
program neighbours_test
  use, intrinsic :: iso_c_binding
  use mpi
  use rrcb
  implicit none
  ! In memory that is there until the end, so that no leak is found.
  save
  real(c_double), parameter :: radius = 0.1_c_double, travel = 0.05_c_double
  real(c_double), parameter :: lower(3) = 0, upper(3) = 1
  integer :: rank, num_ranks, error, step, k
  type(rrcb_balancer) :: balancer
  type(rrcb_neighbours) :: neighbours
  real(c_double), allocatable, target :: x(:, :), ghost_x(:, :), sums(:, :), expected(:, :)
  integer(c_int64_t), allocatable, target :: ids(:), ghost_ids(:), all_ids(:)
  real(c_float), allocatable, target :: values(:)
  integer(c_int), allocatable :: ranks(:)
  type(rrcb_array) :: columns(2), arrays(2), axes(3)
  type(rrcb_ghosts) :: ghosts
  type(rrcb_ghost_plan) :: lists, plan
  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call MPI_Comm_size(MPI_COMM_WORLD, num_ranks, error)
  call balance_points()
  call neighbours%create(balancer, error)
  call expect(error == rrcb_invalid_argument, "no radius")
  call expect(index(rrcb_last_error(), "cutoff and travel are both 0") > 0, "text of no radius")
  call neighbours%create(balancer, error, radius, travel, lower, upper)
  call expect(error == rrcb_ok, "neighbours")
  call neighbours%ranks(ranks)
  call expect(all(ranks /= rank) .and. size(ranks) < num_ranks, "ranks")
  do step = 1, 5
    call drift()
    call columns(1)%take(x)
    call columns(2)%take(ids)
    call expect(.not. allocated(x), "x is taken")
    call neighbours%migrate(columns, error)
    call expect(error == rrcb_ok, "migrate")
    call columns(1)%give(x)
    call columns(2)%give(ids)
    call expect(size(x, 2) == size(ids), "one number of points")
    call check_points()
    call check_ghosts()
  end do
  call check_axes()
  call check_sums()
  call neighbours%destroy()
  call check_errors()
  call balancer%destroy()
  call MPI_Finalize(error)

contains

  ! Position of a point after some steps, found on any rank from its number.
  function place_of(id, steps) result(place)
    integer(c_int64_t), intent(in) :: id
    integer, intent(in) :: steps
    real(c_double) :: place(2)
    integer :: s
    place = [modulo(0.6180339887_c_double*id, 1.0_c_double), modulo(0.7548776662_c_double*id, 1.0_c_double)]
    do s = 1, steps
      place = modulo(place + 0.5_c_double*travel*[sin(id + 7.0_c_double*s), cos(id + 7.0_c_double*s)], 1.0_c_double)
    end do
  end function

  ! Balances the points; those of rank r are part r then.
  subroutine balance_points()
    integer(c_int32_t), allocatable :: parts(:)
    real(c_double), allocatable, target :: first(:, :)
    integer(c_int64_t), allocatable, target :: numbers(:)
    type(rrcb_plan_lists) :: moves
    numbers = [(int(k, c_int64_t), k=rank + 1, 600, num_ranks)]
    first = reshape([(place_of(numbers(k), 0), k=1, size(numbers))], [2, size(numbers)])
    allocate (parts(size(numbers)))
    call balancer%create(MPI_COMM_WORLD)
    call balancer%balance(rrcb_interleaved_points(first), parts)
    call balancer%plan(parts)
    call balancer%get_plan(moves)
    allocate (x(2, moves%num_points_after), ids(moves%num_points_after))
    call balancer%transfer([rrcb_column(first, x), rrcb_column(numbers, ids)])
  end subroutine

  subroutine drift()
    do k = 1, size(ids)
      x(:, k) = place_of(ids(k), step)
    end do
  end subroutine

  ! Each point is on the rank of its part, and none is lost.
  subroutine check_points()
    integer(c_int32_t) :: part
    integer :: counts(2)
    do k = 1, size(ids)
      call expect(all(x(:, k) == place_of(ids(k), step)), "rows that belong together")
      call balancer%part_of(x(:, k), part)
      call expect(part == rank, "the owner")
    end do
    call MPI_Allreduce([size(ids), int(sum(ids))], counts, 2, MPI_INTEGER, MPI_SUM, MPI_COMM_WORLD, error)
    call expect(all(counts == [600, 600*601/2]), "all points")
  end subroutine

  ! Lists, values and sums are those of the collective procedures.
  subroutine check_ghosts()
    integer(c_int32_t), allocatable :: parts(:)
    real(c_double), allocatable, target :: near(:, :)
    allocate (parts(size(ids)))
    call balancer%assign_all(rrcb_interleaved_points(x), parts)
    call ghosts%create(balancer, rrcb_interleaved_points(x), cutoff=radius, lower=lower, upper=upper)
    call ghosts%get_plan(plan)
    allocate (near(2, plan%num_ghosts))
    call ghosts%fetch([rrcb_column(x, near)])
    call neighbours%find_ghosts(rrcb_interleaved_points(x), error)
    call expect(error == rrcb_ok, "find_ghosts")
    if (step == 1) allocate (ghost_x(2, 0))
    call arrays(1)%take(ghost_x)
    call arrays(2)%take(ghost_ids)
    call neighbours%fetch([rrcb_column(x, x), rrcb_column(ids, ids)], arrays, error)
    call expect(error == rrcb_ok, "fetch")
    call arrays(1)%give(ghost_x)
    call arrays(2)%give(ghost_ids)
    call neighbours%ghost_plan(lists)
    call expect(lists%num_ghosts == plan%num_ghosts, "number of ghosts")
    call expect(all(lists%send_indices == plan%send_indices), "points to send")
    call expect(all(lists%shifts == plan%shifts), "shifts")
    call expect(all(ghost_x == near), "ghosts")
    call expect(all([(all(ghost_x(:, k) == place_of(ghost_ids(k), step)), k=1, size(ghost_ids))]), "ids")
    sums = x
    expected = x
    call neighbours%accumulate([rrcb_column(ghost_x, sums)], error)
    call expect(error == rrcb_ok, "accumulate")
    call ghosts%accumulate([rrcb_column(near, expected)])
    call expect(all(sums == expected), "sums")
    call neighbours%apply_shifts(ghost_x, error)
    call ghosts%apply_shifts(near)
    call expect(error == rrcb_ok .and. all(ghost_x == near), "images")
    call ghosts%destroy()
  end subroutine

  ! Coordinates in an array for each axis.
  subroutine check_axes()
    real(c_double), allocatable :: first(:), second(:)
    integer(c_int32_t), allocatable :: numbers(:)
    step = 6
    call drift()
    first = x(1, :)
    second = x(2, :)
    numbers = int(ids)
    call axes(1)%take(first)
    call axes(2)%take(second)
    call axes(3)%take(numbers)
    call neighbours%migrate(axes, error, axes=2)
    call expect(error == rrcb_ok, "migrate by axes")
    call axes(1)%give(first)
    call axes(2)%give(second)
    call axes(3)%give(numbers)
    ids = int(numbers, c_int64_t)
    x = transpose(reshape([first, second], [size(first), 2]))
    call check_points()
  end subroutine

  ! The second of three entries is that of all ranks that are near each other.
  subroutine check_sums()
    values = [1.0_c_float, 2.0_c_float**rank, 3.0_c_float]
    call neighbours%sum(ranks, [(1_c_size_t, k=1, size(ranks))], [(2_c_size_t, k=1, size(ranks))], &
      [rrcb_column(values, values)], error)
    call expect(error == rrcb_ok, "sum")
    call expect(all(values == [1.0_c_float, 2.0_c_float**rank + sum(2.0_c_float**ranks), 3.0_c_float]), "values")
  end subroutine

  subroutine check_errors()
    real(c_double), target :: radii(1) = radius
    ! A point outside of the box reaches all ranks, and no point is lost.
    call neighbours%create(balancer, cutoff=radius, travel=travel, lower=lower, upper=upper)
    call neighbours%find_ghosts(rrcb_interleaved_points(x), error, radii)
    call expect(error == merge(rrcb_ok, rrcb_invalid_argument, size(x, 2) == 1), "one radius")
    call expect(index(rrcb_last_error(), "cutoffs has 1 entries for") > 0, "text of one cutoff")
    call neighbours%destroy()
    call neighbours%create(balancer, cutoff=radius, travel=travel, lower=lower, upper=upper)
    if (rank == 0) x(1, 1) = 1.7_c_double
    call columns(1)%take(x)
    call columns(2)%take(ids)
    do k = 0, num_ranks
      call neighbours%migrate(columns, error)
      if (error /= rrcb_ok) exit
    end do
    call expect(error == rrcb_invalid_argument, "a far jump")
    call expect(index(rrcb_last_error(), "rank 0: point 0 (the first is 0)") > 0, "text of the jump")
    call columns(1)%give(x)
    call columns(2)%give(ids)
    if (rank == 0) x(1, 1) = 0
    call neighbours%destroy()
    ! An array of another type on one rank, and none.
    call neighbours%create(balancer, cutoff=radius, travel=travel)
    all_ids = ids
    if (rank == 0) then
      ghost_x = reshape(real(ids, c_double), [1, size(ids)])
      call columns(2)%take(ghost_x)
    else
      call columns(2)%take(all_ids)
    end if
    call columns(1)%take(x)
    do k = 0, num_ranks
      call neighbours%migrate(columns, error)
      if (error /= rrcb_ok) exit
    end do
    call expect(error /= rrcb_ok .or. num_ranks == 1, "another type")
    call columns(1)%give(x)
    call neighbours%destroy()
    call neighbours%create(balancer, cutoff=radius, travel=travel)
    call neighbours%migrate(columns, error)
    call expect(error == rrcb_invalid_argument, "an array that was given back")
    call expect(index(rrcb_last_error(), "let it take an array before") > 0, "text of no array")
    call neighbours%destroy()
  end subroutine

  subroutine expect(holds, name)
    logical, intent(in) :: holds
    character(*), intent(in) :: name
    if (holds) return
    print '(a, i0, 4a)', "rank ", rank, ": ", name, ": ", rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, 1, error)
  end subroutine

end program
