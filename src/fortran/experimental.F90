!> Without a promise: the costs of points, and keys of overlapping groups. Any version may change this module.
module rrcb_experimental
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_functions
  use rrcb_functions
  use rrcb_balancers, only: rrcb_balancer
  use rrcb_controllers, only: rrcb_controller
#ifdef RRCB_MPI_F08
  use mpi_f08, only: MPI_Comm
#endif
  implicit none
  private
  public :: rrcb_join_keys

  !> Learns the costs of points. A copy refers to the same model, so destroy only one of them.
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
  !> @param comm        may be freed before the model
  !> @param controller  carries the sums with its steps; it must have recorded none, and outlive the model
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

  !> Writes one key for each point of overlapping groups. Collective.
  !> @param balancer whose communicator is used; its cuts are not
  !> @param keys     of shape (keys of a point, points); -1 in place of missing keys
  !> @param joined   gets one for each point, for create()
  subroutine rrcb_join_keys(balancer, keys, joined, error)
    class(rrcb_balancer), intent(in) :: balancer
    integer(c_int64_t), intent(in), target, contiguous :: keys(:, :)
    integer(c_int64_t), intent(inout), target, contiguous :: joined(:)
    integer, intent(out), optional :: error
    type(c_ptr) :: from, to
    from = c_null_ptr
    to = c_null_ptr
    if (size(keys) > 0) from = c_loc(keys)
    if (size(joined) > 0 .and. size(joined) == size(keys, 2)) to = c_loc(joined)
    call settle(c_join_keys(balancer%handle, size(keys, 2, kind=c_size_t), &
      size(keys, 1, kind=c_size_t), from, to), error)
  end subroutine

  !> Returns the state as bytes, which are the same on every rank. Collective.
  subroutine cost_model_save(self, bytes, error)
    class(rrcb_cost_model), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: error
    call save_by(c_cost_model_save, self%handle, bytes, error)
  end subroutine

  !> Makes a model that continues from saved bytes. Collective over the communicator.
  !> @param comm       may be freed before the model
  !> @param bytes      the same on every rank
  !> @param controller must have been loaded before, and must outlive the model
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
  !> @param controller  carries the sums with its steps; it must have recorded none, and outlive the model
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

  !> Writes the weights of points. Call it on all ranks; it does not communicate.
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

  !> Writes the seconds that one unit of each column costs. Not collective.
  subroutine cost_model_costs(self, costs, error)
    class(rrcb_cost_model), intent(in) :: self
    real(c_double), intent(inout), contiguous :: costs(:)
    integer, intent(out), optional :: error
    call settle(c_cost_model_costs(self%handle, size(costs, kind=c_size_t), costs), error)
  end subroutine

  !> Returns whether the weights use the costs; false for a model that was not created. Not
  !> collective.
  function cost_model_uses_costs(self) result(uses_costs)
    class(rrcb_cost_model), intent(in) :: self
    logical :: uses_costs
    integer(c_int) :: answer
    answer = 0
    uses_costs = c_cost_model_uses_costs(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  !> Returns a sentence that explains whether costs are used, and why. Not collective.
  function cost_model_report(self) result(text)
    class(rrcb_cost_model), intent(in) :: self
    character(:), allocatable :: text
    text = text_of(c_cost_model_report(self%handle))
  end function

end module rrcb_experimental
