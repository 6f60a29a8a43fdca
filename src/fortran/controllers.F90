!> The time to rebalance, and the costs of points.
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

  !> Decides when to rebalance. A copy is the same controller; one of them is destroyed.
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

  !> Learns the costs of points. A copy is the same model; one of them is destroyed.
  type, public :: rrcb_cost_model
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
  contains
    procedure, private :: cost_model_create, cost_model_create_alone
#ifdef RRCB_MPI_F08
    procedure, private :: cost_model_create_by_type, cost_model_create_alone_by_type
    generic :: create => cost_model_create_by_type
    generic :: create => cost_model_create_alone_by_type
#endif
    generic :: create => cost_model_create
    generic :: create => cost_model_create_alone
    procedure :: destroy => cost_model_destroy
    procedure :: save => cost_model_save
    procedure :: load => cost_model_load
    procedure :: step => cost_model_step
    procedure :: weights => cost_model_weights
    procedure :: num_columns => cost_model_num_columns
    procedure :: costs => cost_model_costs
    procedure :: uses_costs => cost_model_uses_costs
    procedure :: report => cost_model_report
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

  !> Does the same with the type of `use mpi_f08`.
  !> @param comm        may be freed before the model
  !> @param controller  carries the sums with its steps: is destroyed later, has recorded none
  !> @param num_columns the same on every rank
  subroutine cost_model_create_by_type(self, comm, controller, num_columns, error)
    class(rrcb_cost_model), intent(inout) :: self
    type(MPI_Comm), intent(in) :: comm
    class(rrcb_controller), intent(in) :: controller
    integer, intent(in) :: num_columns
    integer, intent(out), optional :: error
    call self%create(comm%mpi_val, controller, num_columns, error)
  end subroutine

  !> Does the same with the type of `use mpi_f08`.
  !> @param comm        may be freed before the model
  !> @param num_columns the same on every rank
  subroutine cost_model_create_alone_by_type(self, comm, num_columns, error)
    class(rrcb_cost_model), intent(inout) :: self
    type(MPI_Comm), intent(in) :: comm
    integer, intent(in) :: num_columns
    integer, intent(out), optional :: error
    call self%create(comm%mpi_val, num_columns, error)
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

  !> Records a step that took this rank `load` of its own work, without waiting. Collective.
  subroutine controller_step(self, load, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: load
    integer, intent(out), optional :: error
    integer(c_int) :: due
    call settle(c_controller_step(self%handle, load, due), error)
  end subroutine

  !> Records a step and smooths the load; prefer it for measured loads. Collective.
  !> @param load   of this rank's own work, without waiting
  !> @param weight of this rank's points: the sum of the weights balanced by, their number only
  !> without weights
  subroutine controller_step_weight(self, load, weight, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: load, weight
    integer, intent(out), optional :: error
    integer(c_int) :: due
    call settle(c_controller_step_weight(self%handle, load, weight, due), error)
  end subroutine

  !> Returns whether to rebalance before the next step; false for a controller that was not created.
  function controller_due(self) result(due)
    class(rrcb_controller), intent(in) :: self
    logical :: due
    integer(c_int) :: answer
    answer = 0
    due = c_controller_due(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  !> Records a rebalance. Called on all ranks, without communication.
  !> @param report of the balance
  !> @param cost   on this rank, in the unit of the loads
  subroutine controller_rebalanced(self, report, cost, error)
    class(rrcb_controller), intent(inout) :: self
    type(rrcb_report), intent(in) :: report
    real(c_double), intent(in) :: cost
    integer, intent(out), optional :: error
    call settle(c_controller_rebalanced(self%handle, report, cost), error)
  end subroutine

  !> Records a rebalance by a balancer without a report. On all ranks, without communication.
  subroutine controller_rebalanced_cost(self, cost, error)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: cost
    integer, intent(out), optional :: error
    call settle(c_controller_rebalanced(self%handle, cost=cost), error)
  end subroutine

  !> Returns the state as bytes, the same on every rank. Collective.
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

  !> Returns the state as bytes, the same on every rank. Collective.
  subroutine cost_model_save(self, bytes, error)
    class(rrcb_cost_model), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: error
    call save_by(c_cost_model_save, self%handle, bytes, error)
  end subroutine

  !> Makes a model that continues from saved bytes. Collective over the communicator.
  !> @param comm       may be freed before the model
  !> @param bytes      the same on every rank
  !> @param controller loaded before, is destroyed later
  subroutine cost_model_load(self, comm, bytes, error, controller)
    class(rrcb_cost_model), intent(inout), target :: self
    integer, intent(in) :: comm
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: error
    class(rrcb_controller), intent(in), target, optional :: controller
    type(c_ptr), pointer :: steps
    steps => null()
    if (present(controller)) steps => controller%handle
    call settle(c_cost_model_load(int(comm, c_int), steps, bytes, size(bytes, kind=c_size_t), &
      room_for(self%handle)), error)
  end subroutine

  !> Makes a model. Collective over the communicator.
  !> @param comm        may be freed before the model
  !> @param controller  carries the sums with its steps: is destroyed later, has recorded none
  !> @param num_columns the same on every rank
  subroutine cost_model_create(self, comm, controller, num_columns, error)
    class(rrcb_cost_model), intent(inout), target :: self
    integer, intent(in) :: comm
    class(rrcb_controller), intent(in), target :: controller
    integer, intent(in) :: num_columns
    integer, intent(out), optional :: error
    call settle(c_cost_model_create(int(comm, c_int), controller%handle, int(num_columns, c_int), &
      room_for(self%handle)), error)
  end subroutine

  !> Makes a model without a controller, on a communicator of its own. Collective.
  !> @param comm        may be freed before the model
  !> @param num_columns the same on every rank
  subroutine cost_model_create_alone(self, comm, num_columns, error)
    class(rrcb_cost_model), intent(inout), target :: self
    integer, intent(in) :: comm, num_columns
    integer, intent(out), optional :: error
    call settle(c_cost_model_create(int(comm, c_int), num_columns=int(num_columns, c_int), &
      handle=room_for(self%handle)), error)
  end subroutine

  !> Frees the model. Collective unless it was made with a controller.
  subroutine cost_model_destroy(self)
    class(rrcb_cost_model), intent(inout) :: self
    call c_cost_model_destroy(self%handle)
  end subroutine

  !> Records a step. Collective.
  !> @param seconds of this rank's own work, without waiting
  !> @param columns numbers of this rank, one for each column
  subroutine cost_model_step(self, seconds, columns, error)
    class(rrcb_cost_model), intent(inout) :: self
    real(c_double), intent(in) :: seconds
    real(c_double), intent(in), contiguous :: columns(:)
    integer, intent(out), optional :: error
    call settle(c_cost_model_step(self%handle, seconds, size(columns, kind=c_size_t), columns), error)
  end subroutine

  !> Writes the weights of points. Called on all ranks, without communication.
  !> @param columns of shape (columns, points)
  !> @param weights gets one for each point
  subroutine cost_model_weights(self, columns, weights, error)
    class(rrcb_cost_model), intent(inout) :: self
    real(c_double), intent(in), contiguous :: columns(:, :)
    real(c_double), intent(inout), target, contiguous :: weights(:)
    integer, intent(out), optional :: error
    type(c_ptr) :: to
    to = c_null_ptr
    if (size(weights) > 0 .and. size(weights) == size(columns, 2)) to = c_loc(weights)
    call settle(c_cost_model_weights(self%handle, size(columns, 2, kind=c_size_t), &
      size(columns, 1, kind=c_size_t), columns, to), error)
  end subroutine

  !> Returns the number of columns; 0 for a model that was not created. Not collective.
  function cost_model_num_columns(self) result(num_columns)
    class(rrcb_cost_model), intent(in) :: self
    integer :: num_columns
    integer(c_int) :: answer
    answer = 0
    num_columns = 0
    if (c_cost_model_num_columns(self%handle, answer) == rrcb_ok) num_columns = answer
  end function

  !> Writes the cost of a unit of each column. Not collective.
  subroutine cost_model_costs(self, costs, error)
    class(rrcb_cost_model), intent(in) :: self
    real(c_double), intent(inout), contiguous :: costs(:)
    integer, intent(out), optional :: error
    call settle(c_cost_model_costs(self%handle, size(costs, kind=c_size_t), costs), error)
  end subroutine

  !> Returns whether weights are by the costs; false for a model that was not created. Not collective.
  function cost_model_uses_costs(self) result(uses_costs)
    class(rrcb_cost_model), intent(in) :: self
    logical :: uses_costs
    integer(c_int) :: answer
    answer = 0
    uses_costs = c_cost_model_uses_costs(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  !> Returns a sentence: whether costs are used, and why. Not collective.
  function cost_model_report(self) result(text)
    class(rrcb_cost_model), intent(in) :: self
    character(:), allocatable :: text
    text = text_of(c_cost_model_report(self%handle))
  end function

end module rrcb_controllers
