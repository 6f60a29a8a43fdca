! The loop of examples/loop in Fortran. It prints the same numbers on the same number of ranks, and
! writes the same file.
program loop
  use, intrinsic :: iso_c_binding
  use mpi_f08
  use rrcb
  use rrcb_experimental
  implicit none

  integer, parameter :: dp = c_double, cells_per_axis = 101
  real(dp), parameter :: radius = 0.01_dp, cost = 100000
  real(dp), parameter :: travel = 0.005_dp ! the furthest that a particle moves in a step
  type(rrcb_balancer) :: balancer
  type(rrcb_controller) :: controller
  type(rrcb_cost_model) :: model
  type(rrcb_neighbours) :: neighbours
  type(rrcb_array) :: arrays(1), ghosts(1)
  type(rrcb_plan_lists) :: plan
  type(rrcb_report) :: report
  real(dp), allocatable, target :: positions(:, :), moved(:, :), fetched(:, :), weights(:)
  real(dp), allocatable :: columns(:, :)
  integer(c_int8_t), allocatable :: of_controller(:), of_model(:), of_cuts(:)
  character(1000) :: argument
  integer(c_int32_t), allocatable :: parts(:)
  real(dp) :: load, all_loads, heaviest_load, heaviest, total
  integer :: rank, num_ranks, error, first, step, num_steps, rebalances
  logical :: continues, is_divided

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, num_ranks)
  num_steps = 100
  call get_command_argument(1, argument)
  if (argument /= '') read (argument, *) num_steps
  call get_command_argument(2, argument)
  continues = .false.
  if (argument /= '') inquire (file=argument, exist=continues)
  call balancer%create(MPI_COMM_WORLD, error); call check(error)
  if (continues) then
    call read_run(trim(argument))
    call controller%load(MPI_COMM_WORLD%mpi_val, of_controller, error); call check(error)
    call model%load(MPI_COMM_WORLD%mpi_val, of_model, error, controller); call check(error)
    if (size(of_cuts) > 0) then
      call balancer%load_cuts(of_cuts, error); call check(error)
    end if
    is_divided = size(of_cuts) > 0
    if (rank == 0) print '(a, i0, 2a)', "continued at step ", first, ": ", model%report()
  else
    positions = strip_of(rank, num_ranks)
    allocate (columns(2, size(positions, 2)))
    columns = 0
    first = 0
    heaviest = 0
    total = 0
    rebalances = 0
    is_divided = .false.
    call controller%create(MPI_COMM_WORLD, error); call check(error)
    call model%create(MPI_COMM_WORLD, controller, 2, error); call check(error)
  end if
  if (is_divided) then
    call neighbours%create(balancer, error, radius, travel); call check(error)
  end if
  allocate (fetched(2, 0))
  do step = first + 1, num_steps
    if (.not. is_divided .or. controller%due()) then
      allocate (parts(size(positions, 2)), weights(size(positions, 2)))
      call model%weights(columns, weights, error); call check(error)
      call balancer%balance(rrcb_interleaved_points(positions, weights), parts, error); call check(error)
      call balancer%plan(parts, error); call check(error)
      call balancer%get_plan(plan, error); call check(error)
      allocate (moved(2, plan%num_points_after))
      call balancer%transfer([rrcb_column(positions, moved)], error); call check(error)
      call move_alloc(moved, positions)
      deallocate (parts, weights)
      call neighbours%destroy()
      call neighbours%create(balancer, error, radius, travel); call check(error)
      call balancer%get_report(report, error); call check(error)
      call controller%rebalanced(report, cost, error); call check(error)
      rebalances = rebalances + 1
      is_divided = .true.
    else
      call arrays(1)%take(positions)
      call neighbours%migrate(arrays, error); call check(error)
      call arrays(1)%give(positions)
    end if
    call neighbours%find_ghosts(rrcb_interleaved_points(positions), error); call check(error)
    call ghosts(1)%take(fetched)
    call neighbours%fetch([rrcb_column(positions, positions)], ghosts, error); call check(error)
    call ghosts(1)%give(fetched)
    columns = rows_of(count_neighbours(positions, fetched))
    ! All particles move towards the wall at x = 0, where they become dense.
    positions(1, :) = positions(1, :) - 0.02_dp*positions(1, :)*(1 - positions(1, :))
    load = sum(columns(2, :))
    call model%step(load, [real(size(positions, 2), dp), load], error); call check(error)

    call MPI_Allreduce(load, heaviest_load, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
    call MPI_Allreduce(load, all_loads, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    heaviest = heaviest + heaviest_load
    total = total + all_loads
  end do
  if (argument /= '') then
    call controller%save(of_controller, error); call check(error)
    call model%save(of_model, error); call check(error)
    call balancer%save_cuts(of_cuts, error); call check(error)
    call write_run(trim(argument))
  end if
  call neighbours%destroy()
  call model%destroy()
  call controller%destroy()
  call balancer%destroy()
  if (rank == 0) then
    print '(i0, a, i0, a)', nint(total), " pairs of neighbours met in ", num_steps, " steps"
    print '(i0, a, f11.9)', rebalances, " rebalances, mean imbalance ", heaviest*num_ranks/total
  end if
  call MPI_Finalize()

contains

  ! Ends all ranks if a call fails. The error is the same on each rank.
  subroutine check(code)
    integer, intent(in) :: code
    if (code == rrcb_ok) return
    print '(a)', rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, code)
  end subroutine

  ! Returns the values of all ranks on rank 0, in the order of the ranks.
  function gathered(mine) result(all)
    real(dp), intent(in) :: mine(:)
    real(dp), allocatable :: all(:)
    integer :: counts(num_ranks), begins(num_ranks), k
    call MPI_Allgather(size(mine), 1, MPI_INTEGER, counts, 1, MPI_INTEGER, MPI_COMM_WORLD)
    begins = [(sum(counts(:k - 1)), k=1, num_ranks)]
    allocate (all(sum(counts)))
    call MPI_Gatherv(mine, size(mine), MPI_DOUBLE_PRECISION, all, counts, begins, &
                     MPI_DOUBLE_PRECISION, 0, MPI_COMM_WORLD)
  end function

  ! Writes the run from rank 0. The number of values precedes each record. The state that the
  ! library saves is the same on every rank.
  subroutine write_run(path)
    character(*), intent(in) :: path
    real(dp), allocatable :: sizes(:), x(:), rows(:)
    integer :: file
    sizes = gathered([real(size(positions), dp)])
    x = gathered(reshape(positions, [size(positions)]))
    rows = gathered(reshape(columns, [size(columns)]))
    if (rank /= 0) return
    open (newunit=file, file=path, access='stream', form='unformatted', status='replace')
    write (file) 4_c_int64_t, real(num_steps, dp), real(rebalances, dp), heaviest, total
    write (file) size(of_controller, kind=c_int64_t), of_controller
    write (file) size(of_model, kind=c_int64_t), of_model
    write (file) size(of_cuts, kind=c_int64_t), of_cuts
    write (file) size(sizes, kind=c_int64_t), sizes
    write (file) size(x, kind=c_int64_t), x
    write (file) size(rows, kind=c_int64_t), rows
    close (file)
  end subroutine

  function next_bytes(file) result(bytes)
    integer, intent(in) :: file
    integer(c_int8_t), allocatable :: bytes(:)
    integer(c_int64_t) :: length
    read (file) length
    allocate (bytes(length))
    read (file) bytes
  end function

  function next_numbers(file) result(numbers)
    integer, intent(in) :: file
    real(dp), allocatable :: numbers(:)
    integer(c_int64_t) :: length
    read (file) length
    allocate (numbers(length))
    read (file) numbers
  end function

  ! Every rank reads the file. If the number of ranks is that of the file, each keeps its own
  ! particles. Otherwise each takes an equal share, and the cuts are dropped.
  subroutine read_run(path)
    character(*), intent(in) :: path
    real(dp), allocatable :: numbers(:), sizes(:), x(:), rows(:)
    integer :: file, begin, last
    open (newunit=file, file=path, access='stream', form='unformatted', action='read')
    numbers = next_numbers(file)
    of_controller = next_bytes(file)
    of_model = next_bytes(file)
    of_cuts = next_bytes(file)
    sizes = next_numbers(file)
    x = next_numbers(file)
    rows = next_numbers(file)
    close (file)
    first = nint(numbers(1))
    rebalances = nint(numbers(2))
    heaviest = numbers(3)
    total = numbers(4)
    begin = size(rows)/2*rank/num_ranks*2
    last = size(rows)/2*(rank + 1)/num_ranks*2
    if (size(sizes) == num_ranks) then
      begin = nint(sum(sizes(:rank)))
      last = begin + nint(sizes(rank + 1))
    else
      of_cuts = [integer(c_int8_t) ::]
    end if
    positions = reshape(x(begin + 1:last), [2, (last - begin)/2])
    columns = reshape(rows(begin + 1:last), [2, (last - begin)/2])
  end subroutine

  ! Returns this rank's strip of a unit square of 200 x 200 particles.
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

  ! Returns how many particles and ghosts are within the radius of each local particle.
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

  ! Returns a row of two columns for each particle: 1, and the number of its neighbours.
  function rows_of(neighbours) result(rows)
    integer, intent(in) :: neighbours(:)
    real(dp) :: rows(2, size(neighbours))
    rows(1, :) = 1
    rows(2, :) = neighbours
  end function

end program

! Output on 4 ranks:
! 66744352 pairs of neighbours met in 100 steps
! 6 rebalances, mean imbalance 1.101568684
