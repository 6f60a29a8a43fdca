! Rank 0 holds 300 points in a row, at 1, 2, ... 300, on 3 ranks: what the parts are can be counted.
program module_test
  use, intrinsic :: iso_c_binding
  use mpi
  use rrcb
  implicit none

  type(rrcb_balancer) :: balancer, other
  type(rrcb_controller) :: controller
  type(rrcb_cost_model) :: model
  type(rrcb_plan) :: plan
  type(rrcb_report) :: report
  type(rrcb_cut), pointer :: cuts(:)
  real(c_double), allocatable :: x(:, :), weights(:), moved(:, :), moved_weights(:)
  integer(c_int32_t), allocatable :: parts(:), again(:), numbers(:), moved_numbers(:)
  integer(c_int64_t), allocatable :: long_numbers(:), moved_long_numbers(:)
  real(c_double) :: lower(3), upper(3), columns(2)
  integer, parameter :: counts(3) = [50, 150, 100]
  integer :: rank, error, code, dimension, i, num_points

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  num_points = merge(300, 0, rank == 0)
  allocate (x(1, num_points), weights(num_points), parts(num_points), again(num_points))
  x(1, :) = [(real(i, c_double), i=1, num_points)]
  weights = 2
  numbers = [(i, i=1, num_points)]
  long_numbers = numbers*10000000000_c_int64_t

  call balancer%create(MPI_COMM_WORLD, error)
  call expect(error == rrcb_ok, "create")
  call balancer%set("refine", "EXACT", error)
  call expect(error == rrcb_ok, "set")
  call balancer%set_part_sizes([1.0_c_double, 3.0_c_double, 2.0_c_double], error)
  call expect(error == rrcb_ok, "set_part_sizes")
  call balancer%balance(x, parts, error, weights)
  call expect(error == rrcb_ok, "balance")
  ! Of sizes 1, 3 and 2: points 1 to 50, 51 to 200 and the rest.
  call expect(all(parts == merge(0, merge(1, 2, numbers <= 200), numbers <= 50)), "parts")
  call balancer%get_report(report, error)
  call expect(report%num_points == 300 .and. report%total_weight == 600, "report")
  call expect(report%imbalance == 1 .and. report%within_tolerance == 1, "imbalance")

  call balancer%gather_cuts(error)
  call expect(error == rrcb_ok, "gather_cuts")
  call balancer%get_cuts(dimension, cuts, error)
  call expect(error == rrcb_ok .and. dimension == 1 .and. size(cuts) == 2, "cuts")
  call expect(cuts(1)%axis == 0 .and. cuts(1)%at(1) > 50 .and. cuts(1)%at(1) <= 51, "first cut")
  call balancer%box_of(1_c_int32_t, lower, upper, error)
  call expect(lower(1) == cuts(1)%at(1) .and. upper(1) == cuts(2)%at(1), "box_of")

  call other%create(MPI_COMM_WORLD, error)
  call other%assign(x, again, error)
  call expect(error == rrcb_invalid_argument .or. num_points == 0, "assign without cuts")
  call other%set_cuts(dimension, cuts, error)
  call expect(error == rrcb_ok, "set_cuts")
  call other%assign(x, again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign")
  again = -1
  call other%assign_all(x, again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign_all")
  again = -1
  call other%set("refine", "NONE", error)
  call other%rebalance(x, again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "rebalance")
  call other%free()

  call balancer%make_plan(parts, error)
  call expect(error == rrcb_ok, "make_plan")
  call balancer%get_plan(plan, error)
  num_points = counts(rank + 1)
  call expect(plan%num_points_after == num_points, "points after")
  call expect(size(plan%export_indices) == merge(250, 0, rank == 0), "exports")
  call expect(size(plan%import_ranks) == merge(0, num_points, rank == 0), "imports")
  if (rank == 0) call expect(plan%export_indices(1) == 50 .and. plan%export_ranks(1) == 1, "export")
  allocate (moved(1, num_points), moved_weights(num_points), moved_numbers(num_points), &
            moved_long_numbers(num_points))
  call balancer%transfer(x, moved, error)
  call expect(error == rrcb_ok, "transfer of vectors")
  call balancer%transfer(weights, moved_weights, error)
  call expect(error == rrcb_ok, "transfer of reals")
  call balancer%transfer(numbers, moved_numbers, error)
  call expect(error == rrcb_ok, "transfer of integers")
  call balancer%transfer(long_numbers, moved_long_numbers, error)
  call expect(error == rrcb_ok, "transfer of long integers")
  numbers = [(i, i=1, num_points)] + sum(counts(:rank))
  call expect(all(moved(1, :) == numbers) .and. all(moved_numbers == numbers), "moved numbers")
  call expect(all(moved_long_numbers == numbers*10000000000_c_int64_t), "moved long numbers")
  call expect(all(moved_weights == 2), "moved weights")

  call balancer%set("colour", "blue", code)
  call expect(code == rrcb_invalid_argument, "code of an error")
  call expect(index(rrcb_last_error(), 'no option "colour"') > 0, "text of an error")
  call expect(index(rrcb_build_info(), "version: "//rrcb_version()) == 1, "build_info")
  call balancer%free()
  call balancer%balance(x, parts, error)
  call expect(error == rrcb_invalid_argument, "balance after free")
  call expect(.not. controller%due(), "due before create")
  call controller%create(MPI_COMM_WORLD, error)
  call expect(error == rrcb_ok, "create a controller")
  call model%create(MPI_COMM_WORLD, 2, error, controller)
  call expect(error == rrcb_ok, "create a cost model")
  call controller%rebalanced(0.5_c_double, error, report)
  call expect(error == rrcb_ok, "rebalanced")
  ! A point costs 2, a cell 5; ranks have different cells.
  do i = 1, 30
    columns = [100.0_c_double, 10.0_c_double*(rank + 1) + modulo(i, 7)]
    call model%step(2*columns(1) + 5*columns(2), columns, error)
    call expect(error == rrcb_ok, "step of the model")
  end do
  call expect(model%uses_costs(), "uses_costs")
  call model%costs(columns, error)
  call expect(all(abs(columns - [2, 5]) < 0.01), "costs")
  call model%weights(reshape([1.0_c_double, 0.5_c_double, 1.0_c_double, 0.0_c_double], [2, 2]), &
                     columns, error)
  call expect(all(abs(columns - [4.5_c_double, 2.0_c_double]) < 0.01), "weights")
  call expect(index(model%report(), "learned costs are used") == 1, "report of the model")
  call model%step(1.0_c_double, [1.0_c_double], error)
  call model%step(1.0_c_double, columns, error)
  call expect(error == rrcb_invalid_argument, "another number of columns")
  call model%free()
  call controller%free()

  call controller%create(MPI_COMM_WORLD, error)
  call controller%step(1.0_c_double, error)
  call controller%step(1.0_c_double, error, points=10.0_c_double)
  call expect(error == rrcb_ok .and. .not. controller%due(), "step of the controller")
  call controller%free()
  call MPI_Finalize(error)

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    print '(3a, i0, 2a)', "not as expected: ", what, " on rank ", rank, ": ", rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, 1, code)
  end subroutine

end program
