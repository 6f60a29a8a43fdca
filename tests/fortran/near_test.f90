! Ghosts of 200 points on a line: their check, and what is refused.
program near_test
  use, intrinsic :: iso_c_binding
  use mpi
  use rrcb
  implicit none
  integer :: rank, num_ranks, error, i
  type(rrcb_balancer) :: balancer
  type(rrcb_ghosts) :: ghosts
  type(rrcb_plan_lists) :: plan
  type(rrcb_verification) :: seen
  real(c_double), target, allocatable :: x(:, :), here(:, :), near(:, :)
  integer(c_int64_t), target, allocatable :: ids(:), ids_here(:)
  integer(c_int32_t), allocatable :: parts(:)
  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call MPI_Comm_size(MPI_COMM_WORLD, num_ranks, error)
  x = reshape([(modulo(0.37_c_double*(rank*200 + i), 1.0_c_double), i=1, 200)], [1, 200])
  ids = [(int(rank*200 + i, c_int64_t), i=1, 200)]
  allocate (parts(200))
  call balancer%create(MPI_COMM_WORLD)
  call balancer%balance(rrcb_interleaved_points(x), parts)
  call balancer%plan(parts)
  call balancer%get_plan(plan)
  allocate (here(1, plan%num_points_after), ids_here(plan%num_points_after))
  call balancer%transfer([rrcb_column(x, here), rrcb_column(ids, ids_here)])
  call ghosts%create(balancer, rrcb_interleaved_points(here), radius=0.1_c_double)
  call ghosts%verify(rrcb_interleaved_points(here), seen, error, 1000000_c_size_t, ids=ids_here, ids_before=ids)
  call expect(error == rrcb_ok .and. seen%num_faults == 0, "sound ghosts")
  call expect(seen%num_pairs > 0 .or. num_ranks == 1, "pairs")
  ! Too small a layer: points that are needed from further away.
  call ghosts%verify(rrcb_interleaved_points(here), seen, error, 1000000_c_size_t, radius=0.15_c_double)
  call expect(seen%num_faults > 0 .or. num_ranks == 1, "faults")
  call expect(all(seen%missing%rank /= rank) .and. size(seen%twice) == 0, "missing ghosts")
  call expect(all(seen%missing%needed_by >= 1 .and. seen%missing%needed_by <= size(ids_here)), "indices")
  call ghosts%verify(rrcb_interleaved_points(here), seen, error, ids=ids_here(2:))
  call expect(error == rrcb_invalid_argument, "too few ids")
  ! Points that went on to the next rank.
  deallocate (parts)
  allocate (parts(size(ids_here)))
  parts = modulo(rank + 1, num_ranks)
  call balancer%plan(parts)
  call balancer%transfer([rrcb_column ::])
  allocate (near(1, 100000))
  call ghosts%fetch([rrcb_column(here, near)], error)
  call expect(error == merge(rrcb_ok, rrcb_invalid_argument, num_ranks == 1), "stale ghosts")
  if (num_ranks > 1) call expect(index(rrcb_last_error(), "the points were transferred since") > 0, "text")
  call ghosts%destroy()
  call balancer%destroy()
  call check_tilted_box()
  call check_half_open_boxes()
  call check_faces()
  call MPI_Finalize(error)

contains

  ! All pairs within 0.1 in a box that is tilted by 0.3, found without the tilt.
  subroutine check_tilted_box()
    real(c_double), parameter :: tilt = 0.3_c_double, stretch = (tilt + sqrt(tilt**2 + 4))/2
    real(c_double), target, allocatable :: all_points(:, :), mine(:, :), own(:, :), images(:, :)
    integer(c_int32_t), allocatable :: parts_of_mine(:)
    type(rrcb_plan_lists) :: moves
    type(rrcb_ghost_plan) :: lists
    integer :: k
    all_points = reshape([(modulo(0.6180339887_c_double*k, 1.0_c_double), modulo(0.7548776662_c_double*k, 1.0_c_double), &
      k=1, 200)], [2, 200])
    mine = all_points(:, rank + 1::num_ranks)
    allocate (parts_of_mine(size(mine, 2)))
    call balancer%create(MPI_COMM_WORLD)
    call balancer%balance(rrcb_interleaved_points(mine), parts_of_mine)
    call balancer%plan(parts_of_mine)
    call balancer%get_plan(moves)
    allocate (own(2, moves%num_points_after))
    call balancer%transfer([rrcb_column(mine, own)])
    call ghosts%create(balancer, rrcb_interleaved_points(own), radius=0.1_c_double*stretch, &
      lower=[0.0_c_double, 0.0_c_double, 0.0_c_double], upper=[1.0_c_double, 1.0_c_double, 1.0_c_double])
    call ghosts%get_plan(lists)
    allocate (images(2, lists%num_ghosts))
    call ghosts%fetch([rrcb_column(own, images)])
    call ghosts%apply_shifts(images)
    do k = 1, size(own, 2)
      call expect(near_count(own(:, k), own, 0) + near_count(own(:, k), images, 0) == &
        near_count(own(:, k), all_points, 1), "pairs in a tilted box")
    end do
    call ghosts%destroy()
    call balancer%destroy()
  end subroutine

  integer function near_count(at, others, periods)
    real(c_double), intent(in) :: at(2), others(:, :)
    integer, intent(in) :: periods
    real(c_double) :: apart(2)
    integer :: j, k, l
    near_count = 0
    do j = 1, size(others, 2)
      do k = -periods, periods
        do l = -periods, periods
          apart = others(:, j) + [k, l] - at
          if (norm2([apart(1) + 0.3_c_double*apart(2), apart(2)]) <= 0.1_c_double) near_count = near_count + 1
        end do
      end do
    end do
  end function

  ! Images of real(4) are never in the half-open box, although a point is on its upper face.
  subroutine check_faces()
    real(c_float), target, allocatable :: mine(:, :), own(:, :), images(:, :)
    integer(c_int32_t), allocatable :: parts_of_mine(:)
    type(rrcb_plan_lists) :: moves
    type(rrcb_ghost_plan) :: lists
    integer :: k
    mine = reshape([0.0_c_float, 1.0_c_float, nearest(1.0_c_float, -1.0_c_float), &
      (real(rank*20 + k, c_float)/(20*num_ranks + 1), k=1, 20)], [1, 23])
    allocate (parts_of_mine(23))
    call balancer%create(MPI_COMM_WORLD)
    call balancer%balance(rrcb_interleaved_points(mine), parts_of_mine)
    call balancer%plan(parts_of_mine)
    call balancer%get_plan(moves)
    allocate (own(1, moves%num_points_after))
    call balancer%transfer([rrcb_column(mine, own)])
    call ghosts%create(balancer, rrcb_interleaved_points(own), radius=0.1_c_double, &
      lower=[0.0_c_double, 0.0_c_double, 0.0_c_double], upper=[1.0_c_double, 1.0_c_double, 1.0_c_double])
    call ghosts%get_plan(lists)
    allocate (images(1, lists%num_ghosts))
    call ghosts%fetch([rrcb_column(own, images)])
    call ghosts%apply_shifts(images)
    call expect(.not. any(lists%shifts(1, :) /= 0 .and. images(1, :) >= 0 .and. images(1, :) < 1), "images outside")
    call ghosts%destroy()
    call balancer%destroy()
  end subroutine

  ! By plain cuts the points of a lattice are in the half-open boxes of their parts.
  subroutine check_half_open_boxes()
    real(c_double), target, allocatable :: nodes(:, :)
    integer(c_int32_t), allocatable :: parts_of_nodes(:)
    real(c_double) :: lower(3), upper(3)
    integer :: k
    nodes = reshape([(real(modulo(k, 15), c_double), real(k/15, c_double), k=rank, 224, num_ranks)], &
      [2, (224 - rank)/num_ranks + 1])
    allocate (parts_of_nodes(size(nodes, 2)))
    call balancer%create(MPI_COMM_WORLD)
    call balancer%set("axes.plain", "ON")
    call balancer%balance(rrcb_interleaved_points(nodes), parts_of_nodes)
    do k = 1, size(nodes, 2)
      call balancer%box_of(parts_of_nodes(k), lower, upper)
      call expect(all(nodes(:, k) >= lower(:2) .and. nodes(:, k) < upper(:2)), "half-open boxes")
    end do
    call balancer%destroy()
  end subroutine

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what
    if (holds) return
    print '(2a)', "wrong: ", what
    error stop 1
  end subroutine

end program near_test
