! Rank 0 holds 300 points in a row, at 1, 2, ... 300, on 3 ranks: what the parts are can be counted.
program module_test
  use, intrinsic :: iso_c_binding
  use mpi
  use rrcb
  use rrcb_experimental
  implicit none

  type(rrcb_balancer) :: balancer, other
  type(rrcb_controller) :: controller
  type(rrcb_cost_model) :: model
  type(rrcb_controller) :: loaded_controller
  type(rrcb_cost_model) :: loaded_model
  integer(c_int8_t), allocatable :: saved(:)
  integer(c_int64_t) :: joined(2)
  real(c_double) :: loaded_costs(2)
  type(rrcb_ghosts) :: ghosts
  type(rrcb_rank_range) :: no_ranks(0)
  type(rrcb_cuts) :: no_cuts
  type(rrcb_groups) :: groups
  type(rrcb_plan_lists) :: plan
  type(rrcb_ghost_plan) :: ghost_plan
  type(rrcb_report) :: report
  type(rrcb_transfer_report) :: messages
  type(rrcb_remap_report) :: kept
  type(rrcb_rank_range) :: ranks
  type(rrcb_cuts) :: cuts
  real(c_double), allocatable, target :: x(:, :), weights(:), moved(:, :), moved_weights(:)
  real(c_float), allocatable, target :: short_x(:, :), short_positions(:)
  real(c_float), allocatable, target :: short(:), moved_short(:), replies(:)
  integer(c_int32_t), allocatable, target :: numbers(:), moved_numbers(:)
  integer(c_int32_t), allocatable :: parts(:), again(:)
  integer(c_int32_t), allocatable, target :: parts_of_groups(:), parts_of_points(:)
  real(c_double), allocatable :: sums(:, :)
  integer(c_int64_t), allocatable, target :: long_numbers(:), moved_long_numbers(:)
  real(c_double), allocatable, target :: images(:, :)
  real(c_double), target :: sizes(3) = [1, 3, 2], turned(5, 3) = 0
  real(c_double) :: lower(3), upper(3), columns(2), of_parts(3), value
  integer(c_int32_t) :: part, new_numbers(3)
  type, bind(c) :: particle
    real(c_double) :: mass, x
    real(c_float) :: short
  end type
  type(particle), allocatable, target :: particles(:), moved_particles(:)
  real(c_double), allocatable, target :: positions(:)
  type(rrcb_points) :: points
  integer, parameter :: counts(3) = [50, 150, 100]
  integer :: rank, error, code, i, k, num_points, kind_of_box

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  num_points = merge(300, 0, rank == 0)
  allocate (x(1, num_points), weights(num_points), parts(num_points), again(num_points))
  x(1, :) = [(real(i, c_double), i=1, num_points)]
  weights = 2
  numbers = [(i, i=1, num_points)]
  long_numbers = numbers*10000000000_c_int64_t
  short = real(numbers, c_float)/2
  allocate (particles(num_points))
  particles%x = x(1, :)
  particles%short = real(x(1, :), c_float)

  call other%create(MPI_COMM_WORLD)
  call other%set("refine", "NONE")
  call other%balance(rrcb_interleaved_points(x), parts)
  images = x**3
  call other%balance(rrcb_interleaved_points(images), parts)
  deallocate (images)
  do i = 1, 3
    k = count(parts == i - 1)
    call expect(num_points == 0 .or. (k > 80 .and. k < 120), "uncounted cuts follow the points")
  end do
  call other%destroy()
  call balancer%create(MPI_COMM_WORLD, error)
  call expect(error == rrcb_ok, "create")
  call balancer%set("refine ", "EXACT ", error)
  call expect(error == rrcb_ok, "set")
  call balancer%set("num_parts", "0", error)
  call expect(error == rrcb_ok, "one part per rank")
  call balancer%set_part_sizes(sizes, error)
  call expect(error == rrcb_ok, "set_part_sizes")
  call balancer%balance(rrcb_interleaved_points(x, weights), parts, error)
  call expect(error == rrcb_ok, "balance")
  ! Of sizes 1, 3 and 2: points 1 to 50, 51 to 200 and the rest.
  call expect(all(parts == merge(0, merge(1, 2, numbers <= 200), numbers <= 50)), "parts")
  call balancer%plan(parts(:size(parts) - 1), error)
  call expect(error == rrcb_invalid_argument, "plan of too few points")
  call balancer%get_report(report, error)
  call expect(report%num_points == 300 .and. report%total_weight == 600, "report")
  call expect(report%imbalance == 1 .and. report%within_tolerance == 1, "imbalance")

  call balancer%get_cuts(cuts, error)
  call expect(error == rrcb_ok .and. cuts%dimension == 1 .and. size(cuts%tree) == 2, "cuts")
  associate (at => cuts%tree(1)%at(1))
    call expect(cuts%tree(1)%axis == 1 .and. at > 50 .and. at <= 51, "first cut")
  end associate
  call balancer%box_of(1_c_int32_t, lower, upper, error)
  call expect(lower(1) == cuts%tree(1)%at(1) .and. upper(1) == cuts%tree(2)%at(1), "box_of")
  call balancer%part_of([60.0_c_double], part, error)
  call expect(error == rrcb_ok .and. part == 1, "part_of")
  call balancer%parts_touching([40.0_c_double], [60.0_c_double], again, error)
  call expect(error == rrcb_ok .and. size(again) == 2 .and. all(again == [0, 1]), "parts_touching")

  call other%create(MPI_COMM_WORLD)
  deallocate (again)
  allocate (again(num_points))
  call other%assign(rrcb_interleaved_points(x), again, error)
  call expect(error == rrcb_invalid_argument, "assign without cuts")
  call other%set_cuts(cuts, error)
  call expect(error == rrcb_ok, "set_cuts")
  call other%assign(rrcb_interleaved_points(x), again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign")
  again = -1
  call expect(all([points%size, report%size, messages%size, kept%size] == &
    [c_sizeof(points), c_sizeof(report), c_sizeof(messages), c_sizeof(kept)]), "sizes of types")
  points = rrcb_points(dimension=1, count=num_points, stride=storage_size(particles)/8)
  if (num_points > 0) points%axes(1) = c_loc(particles(1)%x)
  call other%assign(points, again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign by components")
  again = -1
  points%type = rrcb_float
  if (num_points > 0) points%axes(1) = c_loc(particles(1)%short)
  call other%assign(points, again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign by components of real(4)")
  again = -1
  short_x = real(x, c_float)
  call other%assign(rrcb_interleaved_points(short_x), again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign of real(4)")
  again = -1
  short_positions = short_x(1, :)
  call other%assign(rrcb_column_points(short_positions), again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign of columns of real(4)")
  positions = x(1, :)
  call other%assign_all(rrcb_column_points(positions), again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "assign_all")
  again = -1
  call other%set("refine", "NONE")
  call other%set("imbalance_tolerance", "2")
  call other%set("tree.group_size", "1")
  call other%set("tree.larger_below", "OFF")
  call other%set("tree.round_robin_block", "0")
  call other%set("tolerance", "1.1", error)
  call expect_text("did you mean imbalance_tolerance?")
  call other%balance(rrcb_interleaved_points(x), again, error)
  call expect(error == rrcb_ok .and. all(again == parts), "balance from the cuts")
  call other%balance(rrcb_interleaved_points(x), again(2:), error)
  call expect(error == rrcb_invalid_argument, "too few parts")
  call other%balance(rrcb_interleaved_points(x, sizes), again, error)
  call expect(error == rrcb_invalid_argument, "weights of other points")
  call expect_text("rank 0: weights has 3 entries for 300 points; give one for each")
  call other%balance(rrcb_interleaved_points(turned), again, error)
  call expect_text("coordinates has the shape (5, 3); give (dimension, points)")
  call other%balance(rrcb_column_points(positions, positions(2:)), again, error)
  call expect_text("rank 0: x, y and z must have one length, not 300 and 299")
  call other%balance(rrcb_interleaved_points(x), again(2:), error)
  call expect_text("parts is null (in Fortran: or has the wrong length); it must hold 300 entries")
  call other%create(MPI_COMM_WORLD, error)
  call expect_text("balancer is null; give the address of a pointer (in Fortran: destroy what was")
  ! Of two machines of two ranks, which are dealt in turns.
  cuts%tree = [rrcb_cut(1, 0, [2.0_c_double, 0.0_c_double, 0.0_c_double]), &
               rrcb_cut(1, 0, [1.0_c_double, 0.0_c_double, 0.0_c_double]), &
               rrcb_cut(1, 0, [3.0_c_double, 0.0_c_double, 0.0_c_double])]
  cuts%group_size = 2
  cuts%round_robin_block = 1
  call other%set_cuts(cuts, error)
  call expect(error == rrcb_ok, "set_cuts of dealt parts")
  call other%get_cuts(cuts, error)
  call expect(cuts%group_size == 2 .and. cuts%round_robin_block == 1, "shape of cuts")
  do i = 0, 3
    call other%part_of([i + 0.5_c_double], part, error)
    call expect(part == 2*modulo(i, 2) + i/2, "part_of dealt parts")
  end do
  cuts%numbers = [2_c_int32_t, 0_c_int32_t, 3_c_int32_t, 1_c_int32_t]
  cuts%debt = 0.5
  call other%set_cuts(cuts, error)
  call expect(error == rrcb_ok, "set_cuts with numbers")
  call other%get_cuts(cuts, error)
  call expect(all(cuts%numbers == [2, 0, 3, 1]) .and. cuts%debt == 0.5, "numbers of cuts")
  do i = 0, 3
    call other%part_of([i + 0.5_c_double], part, error)
    call expect(part == cuts%numbers(i + 1), "part_of numbered parts")
  end do
  cuts%numbers(1) = 3
  call other%set_cuts(cuts, error)
  call expect_text("the numbers of cuts must name each part once")
  call other%clear_cuts(error)
  call other%get_cuts(cuts, error)
  call expect(error == rrcb_invalid_argument, "clear_cuts")
  call other%destroy()

  call balancer%part_weights(rrcb_interleaved_points(x, weights), parts, of_parts, error)
  call expect(error == rrcb_ok .and. all(of_parts == [100, 300, 200]), "part_weights")
  call balancer%part_weights(rrcb_interleaved_points(x, weights), parts, of_parts(:2), error)
  call expect(error == rrcb_invalid_argument, "part_weights of too few parts")
  call rrcb_imbalance(of_parts, value, error, sizes)
  call expect(error == rrcb_ok .and. value == 1, "rrcb_imbalance")
  call rrcb_balanced_sizes([4.0_c_double, 4.0_c_double, 4.0_c_double], lower, error)
  call expect(error == rrcb_ok .and. all(lower == 1), "rrcb_balanced_sizes")
  call rrcb_balanced_sizes(of_parts, columns, error)
  call expect_text("part_weights, or an array of one for each part, is null (in Fortran: or has the wrong")
  call rrcb_imbalance(of_parts, value, error, sizes(:2))
  call expect(error == rrcb_invalid_argument, "imbalance of too few sizes")
  call balancer%moved_fraction(rrcb_interleaved_points(x), parts, value, error)
  call expect(error == rrcb_ok .and. abs(value - 5.0_c_double/6) < 1e-15, "moved_fraction")
  call rrcb_bounding_box(rrcb_interleaved_points(x), lower, upper, error)
  call expect(error == rrcb_ok .and. (upper(1) == 300 .or. rank > 0), "rrcb_bounding_box")
  call rrcb_ranks_of_part(2_c_int32_t, 3, 7, ranks, error)
  call expect(error == rrcb_ok .and. ranks%first_rank == 5 .and. ranks%count == 2, "ranks_of_part")
  ! All points are on rank 0, where the largest part is to be.
  call balancer%remap(parts, new_numbers, error, report=kept)
  call expect(error == rrcb_ok .and. new_numbers(2) == 0 .and. kept%kept_after == 150, "remap")
  call balancer%remap(parts, new_numbers, error, previous=parts)
  call expect(error == rrcb_ok .and. all(new_numbers == [0, 1, 2]), "remap of previous")
  call balancer%remap(parts, new_numbers, error, previous=[parts, 0])
  call expect(error == rrcb_invalid_argument, "remap of too many")
  call balancer%remap(parts, new_numbers(:2), error)
  call expect(error == rrcb_invalid_argument, "remap to too few numbers")

  call ghosts%create(balancer, rrcb_interleaved_points(x), error, cutoff=2.0_c_double)
  call expect(error == rrcb_invalid_argument, "ghosts before transfer")
  call balancer%plan(parts, error)
  call expect(error == rrcb_ok, "plan")
  call balancer%get_plan(plan, error)
  num_points = counts(rank + 1)
  call expect(plan%num_points_after == num_points, "points after")
  call expect(size(plan%export_indices) == merge(250, 0, rank == 0), "exports")
  call expect(size(plan%import_ranks) == merge(0, num_points, rank == 0), "imports")
  if (rank == 0) call expect(plan%export_indices(1) == 51 .and. plan%export_ranks(1) == 1, "export")
  allocate (moved(1, num_points), moved_weights(num_points), moved_numbers(num_points), &
            moved_long_numbers(num_points), moved_short(num_points))
  call balancer%transfer([rrcb_column(x, moved), rrcb_column(weights, moved_weights), &
    rrcb_column(numbers, moved_numbers), rrcb_column(long_numbers, moved_long_numbers), &
    rrcb_column(short, moved_short)], error, max_bytes=4096_c_size_t, report=messages)
  call expect(error == rrcb_ok .and. messages%bytes_sent == merge(250*32, 0, rank == 0), "transfer")
  numbers = [(i, i=1, num_points)] + sum(counts(:rank))
  call expect(all(moved(1, :) == numbers) .and. all(moved_numbers == numbers), "moved numbers")
  call expect(all(moved_long_numbers == numbers*10000000000_c_int64_t), "moved long numbers")
  call expect(all(moved_weights == 2) .and. all(moved_short == numbers*0.5), "moved reals")
  call balancer%transfer([rrcb_column(x, moved(:, 2:))], error)
  call expect(error == rrcb_invalid_argument, "transfer to a short array")
  call expect_text("to of column 0 (the first is 0) is null (in Fortran: or too short); it must hold 1 for")
  allocate (moved_particles(num_points))
  call balancer%transfer([rrcb_column(c_sizeof(moved_particles(1)), c_loc(particles), &
    c_loc(moved_particles))], error)
  call expect(error == rrcb_ok .and. all(moved_particles%x == numbers), "transfer of bytes")

  ! Points within 2 of the next part, and of the box that repeats after 300.
  do kind_of_box = 1, 2
    if (kind_of_box == 1) then
      call ghosts%create(balancer, rrcb_interleaved_points(moved), error, cutoff=2.0_c_double)
    else
      call ghosts%create(balancer, rrcb_interleaved_points(moved), error, cutoff=2.0_c_double, &
        lower=[0.5_c_double, 0.0_c_double, 0.0_c_double], &
        upper=[300.5_c_double, 1.0_c_double, 1.0_c_double])
    end if
    call expect(error == rrcb_ok, "create ghosts")
    call ghosts%get_plan(ghost_plan, error)
    i = num_ghosts(kind_of_box == 2)
    call expect(ghost_plan%num_ghosts == i .and. sum(ghost_plan%receive_counts) == i, "ghosts")
    if (rank == 0) call expect(maxval(ghost_plan%send_indices) == 50, "send_indices")
    allocate (images(1, i))
    call ghosts%fetch([rrcb_column(moved, images)], error)
    call expect(error == rrcb_ok, "fetch")
    call ghosts%fetch([rrcb_column(moved, images(:, 2:))], error)
    call expect(error == rrcb_invalid_argument, "fetch to a short array")
    call ghosts%fetch([rrcb_column(moved(:, 2:), images)], error)
    call expect(error == rrcb_invalid_argument, "fetch from a short array")
    call ghosts%apply_shifts(images, error)
    call expect(error == rrcb_ok .and. all([(is_near(images(1, k)), k=1, i)]), "images")
    short_x = real(images, c_float)
    call ghosts%apply_shifts(short_x, error)
    call expect(error == rrcb_ok, "images of real(4)")
    short = [(1.0_c_float, error=1, i)]
    moved_short = 0
    call ghosts%accumulate([rrcb_column(short, moved_short)], error)
    call expect(error == rrcb_ok .and. nint(sum(moved_short)) == sum(ghost_plan%send_counts), "accumulate")
    short = [(real(rank, c_float), error=1, i)]
    if (allocated(replies)) deallocate (replies)
    allocate (replies(size(ghost_plan%send_indices)))
    call ghosts%reply([rrcb_column(short, replies)], error)
    call expect(error == rrcb_ok .and. nint(sum(replies)) == &
      sum(ghost_plan%send_ranks*int(ghost_plan%send_counts)), "reply")
    call ghosts%accumulate([rrcb_column(short(2:), moved_short)], error)
    call expect(error == rrcb_invalid_argument, "accumulate from a short array")
    call ghosts%accumulate([rrcb_column(short, moved_short(2:))], error)
    call expect(error == rrcb_invalid_argument, "accumulate to a short array")
    if (kind_of_box == 2) call expect(allocated(ghost_plan%shifts), "shifts")
    deallocate (images)
    call ghosts%destroy()
  end do
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, cutoffs=0*moved_weights)
  call expect(error == rrcb_ok, "ghosts by radii")
  call ghosts%destroy()
  ! Rank 0 needs two points of the next part, which needs none.
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, &
    cutoffs=moved_weights*merge(1, 0, rank == 0), needs=rrcb_needs_gather)
  call expect(error == rrcb_ok, "ghosts within radii of receivers")
  call ghosts%get_plan(ghost_plan, error)
  call expect(ghost_plan%num_ghosts == merge(2, 0, rank == 0), "number of ghosts within radii of receivers")
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, cutoff=2.0_c_double)
  call expect_text("ghosts is null; give the address of a pointer (in Fortran: destroy what was")
  call ghosts%destroy()
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error)
  call expect(error == rrcb_invalid_argument, "ghosts without a radius")
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, cutoffs=moved_weights(2:))
  call expect(error == rrcb_invalid_argument, "ghosts by too few radii")
  call expect_text("give one for each, or one cutoff for all")
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, 1.0_c_double, moved_weights(2:))
  call expect(error == rrcb_invalid_argument, "ghosts by a radius and too few radii")
  call ghosts%create(balancer, rrcb_interleaved_points(moved), error, 1.0_c_double, ranks_of_parts=no_ranks)
  call expect(error == rrcb_invalid_argument, "ghosts of too few parts")
  call other%set_cuts(no_cuts, error)
  call expect(error == rrcb_invalid_argument, "set_cuts without cuts")
  ! Pairs of points, which cuts do not part, though ranks do.
  call groups%create(balancer, rrcb_interleaved_points(moved), int((numbers + 1)/2, c_int64_t), error)
  call expect(error == rrcb_ok, "create groups")
  call groups%create(balancer, rrcb_interleaved_points(x), long_numbers, error)
  call expect_text("groups is null; give the address of a pointer (in Fortran: destroy what was")
  call groups%points(points, error)
  call expect(error == rrcb_ok .and. points%count == num_points/2, "points of groups")
  deallocate (again)
  allocate (again(points%count))
  call other%create(MPI_COMM_WORLD, error)
  call other%balance(points, again, error)
  call expect(error == rrcb_ok, "balance of groups")
  parts_of_groups = again
  parts_of_points = numbers
  call groups%to_points([rrcb_column(parts_of_groups, parts_of_points)], error)
  call expect(error == rrcb_ok .and. all(parts_of_points(1::2) == parts_of_points(2::2)), "fetch of groups")
  call groups%to_points([rrcb_column(parts_of_groups, parts_of_points(2:))], error)
  call expect(error == rrcb_invalid_argument, "fetch of groups to a short array")
  allocate (sums(1, points%count))
  call groups%sums(moved, sums, error)
  call expect(error == rrcb_ok .and. all(sums(1, :) == moved(1, 1::2) + moved(1, 2::2)), "sums")
  call groups%sums(moved, sums(:, 2:), error)
  call expect(error == rrcb_invalid_argument, "sums to a short array")
  call groups%sums(moved(:, 2:), sums, error)
  call expect(error == rrcb_invalid_argument, "sums of a short array")
  call groups%destroy()
  call other%destroy()
  call balancer%release_buffers(error)
  call expect(error == rrcb_ok, "release_buffers")

  call balancer%set("colour", "blue", error)
  call expect(error == rrcb_invalid_argument, "code of an error")
  call expect_text('no option "colour"')
  call balancer%save_cuts(saved, error)
  call expect(error == rrcb_ok .and. size(saved) > 0, "save cuts")
  call balancer%load_cuts(saved(:size(saved) - 8), error)
  call expect_text("pass all bytes of save")
  call balancer%load_cuts(saved, error)
  call expect(error == rrcb_ok, "load cuts")
  call rrcb_join_keys(balancer, reshape([5_c_int64_t, 9_c_int64_t, 9_c_int64_t, -1_c_int64_t], [2, 2]), &
                      joined, error)
  call expect(error == rrcb_ok .and. all(joined == 5), "join keys")
  call expect(index(rrcb_build_info(), "version: "//rrcb_version()) == 1, "build_info")
  call balancer%destroy()
  call balancer%balance(rrcb_interleaved_points(x), parts, error)
  call expect(error == rrcb_invalid_argument, "balance after free")
  call expect(.not. controller%due(), "due before create")
  call model%create(MPI_COMM_WORLD, controller, 2, error)
  call expect(error == rrcb_invalid_argument, "a cost model of a controller that was not made")
  call controller%create(MPI_COMM_WORLD, error)
  call expect(error == rrcb_ok, "create a controller")
  call model%create(MPI_COMM_WORLD, controller, 2, error)
  call expect(error == rrcb_ok, "create a cost model")
  call model%create(MPI_COMM_WORLD, 2, error)
  call expect_text("model is null; give the address of a pointer (in Fortran: destroy what was")
  call controller%create(MPI_COMM_WORLD, error)
  call expect_text("controller is null; give the address of a pointer (in Fortran: destroy what was")
  call controller%rebalanced(report, 0.5_c_double, error)
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
  call model%weights(reshape([1.0_c_double, 0.5_c_double], [2, 1]), columns, error)
  call expect(error == rrcb_invalid_argument, "weights of too few points")
  call expect(index(model%report(), "learned costs are used") == 1, "report of the model")
  call controller%save(saved, error)
  call expect(error == rrcb_ok .and. size(saved) > 0, "save a controller")
  call loaded_controller%load(MPI_COMM_WORLD, saved(2:), error)
  call expect_text("the bytes are no state")
  call loaded_controller%load(MPI_COMM_WORLD, saved, error)
  call expect(error == rrcb_ok, "load a controller")
  call model%save(saved, error)
  call expect(error == rrcb_ok, "save a model")
  call loaded_model%load(MPI_COMM_WORLD, saved, error, loaded_controller)
  call expect(error == rrcb_ok .and. loaded_model%uses_costs() .and. loaded_model%num_columns() == 2, &
    "load a model")
  call model%costs(columns, error)
  call loaded_model%costs(loaded_costs, error)
  call expect(all(abs(columns - loaded_costs) <= 0), "costs of a loaded model")
  call loaded_model%destroy()
  call loaded_controller%destroy()
  call model%step(1.0_c_double, [1.0_c_double], error)
  call model%step(1.0_c_double, columns, error)
  call expect(error == rrcb_invalid_argument, "another number of columns")
  call model%destroy()
  call controller%destroy()

  call controller%create(MPI_COMM_WORLD, error)
  call controller%step(1.0_c_double, error)
  call controller%step(1.0_c_double, 10.0_c_double, error)
  call expect(error == rrcb_ok .and. .not. controller%due(), "step of the controller")
  call controller%destroy()
  call MPI_Finalize(error)

contains

  logical function is_near(position)
    real(c_double), intent(in) :: position
    call balancer%box_of(int(rank, c_int32_t), lower, upper, code)
    lower(1) = max(lower(1), 0.5_c_double)
    upper(1) = min(upper(1), 300.5_c_double)
    is_near = position >= lower(1) - 2 .and. position <= upper(1) + 2
  end function

  !> Other points near the part of this rank, or images of any.
  integer function num_ghosts(is_periodic)
    logical, intent(in) :: is_periodic
    num_ghosts = 0
    do k = merge(-299, 1, is_periodic), merge(600, 300, is_periodic)
      if (any(moved(1, :) == k)) cycle
      if (is_near(real(k, c_double))) num_ghosts = num_ghosts + 1
    end do
  end function

  subroutine expect_text(text)
    character(*), intent(in) :: text
    call expect(error /= rrcb_ok .and. index(rrcb_last_error(), text) > 0, text)
  end subroutine

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    print '(3a, i0, 2a)', "not as expected: ", what, " on rank ", rank, ": ", rrcb_last_error()
    call MPI_Abort(MPI_COMM_WORLD, 1, code)
  end subroutine

end program
