! Fails without the argument `error`, which ends the program.
program stops_test
  use, intrinsic :: iso_c_binding
  use, intrinsic :: ieee_arithmetic
  use mpi
  use rrcb
  implicit none

  type(rrcb_balancer) :: balancer
  real(c_double), target :: x(1, 2) = 0
  integer(c_int32_t) :: parts(2)
  character(8) :: call_name
  integer :: rank, error

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call balancer%create(MPI_COMM_WORLD)
  call get_command_argument(1, call_name)
  if (call_name == 'set') call balancer%set("colour", "blue")
  if (rank == 2) x = ieee_value(x, ieee_quiet_nan)
  call balancer%balance(rrcb_interleaved_points(x), parts)
  call MPI_Finalize(error)
end program
