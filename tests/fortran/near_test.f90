! Ghosts of 200 points on a line, and what is refused.
program near_test
  use, intrinsic :: iso_c_binding
  use mpi
  use rrcb
  implicit none
  integer :: rank, num_ranks, error, i
  type(rrcb_balancer) :: balancer
  type(rrcb_ghosts) :: ghosts
  type(rrcb_plan_lists) :: plan
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
  call ghosts%create(balancer, rrcb_interleaved_points(here), cutoff=0.1_c_double)
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
  call MPI_Finalize(error)

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what
    if (holds) return
    print '(2a)', "wrong: ", what
    error stop 1
  end subroutine

end program near_test
