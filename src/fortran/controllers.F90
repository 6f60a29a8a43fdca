!> The time to rebalance.
module rrcb_controllers
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_functions
  use rrcb_functions
#ifdef RRCB_MPI_F08
  use mpi_f08, only: MPI_Comm
#endif
  implicit none
  private

  !> Decides when to rebalance. A copy refers to the same controller, so destroy only one of them.
  type, public :: rrcb_controller
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
  contains
    procedure, private :: controller_create
#ifdef RRCB_MPI_F08
    procedure, private :: controller_create_by_type
    generic :: create => controller_create_by_type
#endif
    generic :: create => controller_create
    procedure :: destroy => controller_destroy
    procedure :: save => controller_save
    procedure :: load => controller_load
    procedure, private :: controller_step, controller_step_weight
    generic :: step => controller_step
    generic :: step => controller_step_weight
    procedure :: due => controller_due
    procedure, private :: controller_rebalanced, controller_rebalanced_cost
    generic :: rebalanced => controller_rebalanced
    generic :: rebalanced => controller_rebalanced_cost
  end type

contains

#ifdef RRCB_MPI_F08
  !> Does the same with the type of `use mpi_f08`.
  subroutine controller_create_by_type(self, comm, error)
    class(rrcb_controller), intent(inout) :: self
    type(MPI_Comm), intent(in) :: comm
    integer, intent(out), optional :: error
    call self%create(comm%mpi_val, error)
  end subroutine
#endif

  !> Makes a controller. Collective over the communicator.
  subroutine controller_create(self, comm, error)
    class(rrcb_controller), intent(inout), target :: self
    integer, intent(in) :: comm
    integer, intent(out), optional :: error
    call settle(c_controller_create(int(comm, c_int), room_for(self%handle)), error)
  end subroutine

  !> Frees the controller. Collective.
  subroutine controller_destroy(self)
    class(rrcb_controller), intent(inout) :: self
    call c_controller_destroy(self%handle)
  end subroutine

  !> Records a step in which this rank's own work took `load`, without waiting. Collective.
  subroutine controller_step(self, load, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: load
    integer, intent(out), optional :: error
    integer(c_int) :: due
    call settle(c_controller_step(self%handle, load, c_null_ptr, due), error)
  end subroutine

  !> Records a step and smooths the load; prefer it for measured loads. Collective.
  !> @param load   of this rank's own work, without waiting
  !> @param weight of this rank's points: the sum of the weights given to balance; without weights their
  !> number
  subroutine controller_step_weight(self, load, weight, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: load
    real(c_double), intent(in), target :: weight
    integer, intent(out), optional :: error
    integer(c_int) :: due
    call settle(c_controller_step(self%handle, load, c_loc(weight), due), error)
  end subroutine

  !> Returns whether to rebalance before the next step; false for a controller that was not created.
  function controller_due(self) result(due)
    class(rrcb_controller), intent(in) :: self
    logical :: due
    integer(c_int) :: answer
    answer = 0
    due = c_controller_due(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  !> Records a rebalance. Call it on all ranks; it does not communicate.
  !> @param report of the balance
  !> @param cost   on this rank, in the unit of the loads
  subroutine controller_rebalanced(self, report, cost, error)
    class(rrcb_controller), intent(inout) :: self
    type(rrcb_report), intent(in) :: report
    real(c_double), intent(in) :: cost
    integer, intent(out), optional :: error
    call settle(c_controller_rebalanced(self%handle, report, cost), error)
  end subroutine

  !> Records a rebalance by a balancer without a report. Call it on all ranks; it does not
  !> communicate.
  subroutine controller_rebalanced_cost(self, cost, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: cost
    integer, intent(out), optional :: error
    call settle(c_controller_rebalanced(self%handle, cost=cost), error)
  end subroutine

  !> Returns the state as bytes, which are the same on every rank. Collective.
  subroutine controller_save(self, bytes, error)
    class(rrcb_controller), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: error
    call save_by(c_controller_save, self%handle, bytes, error)
  end subroutine

  !> Makes a controller that continues from saved bytes. Collective over the communicator.
  !> @param comm  may be freed before the controller
  !> @param bytes the same on every rank
  subroutine controller_load(self, comm, bytes, error)
    class(rrcb_controller), intent(inout), target :: self
    integer, intent(in) :: comm
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: error
    call settle(c_controller_load(int(comm, c_int), bytes, size(bytes, kind=c_size_t), &
      room_for(self%handle)), error)
  end subroutine

end module rrcb_controllers
