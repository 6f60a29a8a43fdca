!> The library in Fortran 2008, over rrcb/rrcb.h, which is the manual of what is only named here.
!>
!> Every procedure that can fail gives rrcb_ok or another code as `error`; from a collective one all
!> ranks get the same. Parts and ranks count from 0, as those of MPI do, and so do the indices of the
!> lists; arrays of points have the shape (dimension, points). A communicator is the integer of
!> `mpif.h` and `use mpi`, or comm%mpi_val of `use mpi_f08`.
module rrcb
  use, intrinsic :: iso_c_binding
  use rrcb_c
  implicit none
  private

  integer, parameter, public :: rrcb_ok = 0, rrcb_invalid_argument = 1, rrcb_out_of_memory = 2, &
    rrcb_mpi_error = 3, rrcb_internal_error = 4

  !> Lists of the points whose rank changes; they belong to the balancer until it makes another plan.
  type, public :: rrcb_plan
    integer(c_size_t) :: num_points = 0, num_points_after = 0
    integer(c_size_t), pointer :: export_indices(:) => null(), import_indices(:) => null()
    integer(c_int), pointer :: export_ranks(:) => null(), import_ranks(:) => null()
    integer(c_int32_t), pointer :: export_parts(:) => null(), import_parts(:) => null()
  end type

  !> Communicator, options, cuts and plan. A copy is the same balancer; one of them is freed.
  type, public :: rrcb_balancer
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => balancer_create                  !< collective over the communicator
    procedure :: free => balancer_free
    procedure :: set => balancer_set
    procedure :: set_part_sizes => balancer_set_part_sizes
    procedure :: balance => balancer_balance                !< collective
    procedure :: rebalance => balancer_rebalance            !< collective
    procedure :: get_report => balancer_get_report
    procedure :: get_cuts => balancer_get_cuts
    procedure :: gather_cuts => balancer_gather_cuts        !< collective
    procedure :: set_cuts => balancer_set_cuts
    procedure :: assign => balancer_assign
    procedure :: assign_all => balancer_assign_all          !< collective
    procedure :: box_of => balancer_box_of
    procedure :: make_plan => balancer_make_plan            !< collective
    procedure :: get_plan => balancer_get_plan
    procedure, private :: balancer_transfer_reals, balancer_transfer_vectors, &
      balancer_transfer_integers, balancer_transfer_long_integers
    !> Collective. `to` has room for num_points_after of the plan.
    generic :: transfer => balancer_transfer_reals, balancer_transfer_vectors, &
      balancer_transfer_integers, balancer_transfer_long_integers
  end type

  !> Decides when to rebalance. A copy is the same controller; one of them is freed.
  type, public :: rrcb_controller
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => controller_create                !< collective over the communicator
    procedure :: free => controller_free                    !< collective
    procedure :: step => controller_step                    !< collective
    procedure :: due => controller_due
    procedure :: rebalanced => controller_rebalanced
  end type

  !> Learns what points cost. A copy is the same model; one of them is freed.
  type, public :: rrcb_cost_model
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => cost_model_create                !< collective over the communicator
    procedure :: free => cost_model_free                    !< collective
    procedure :: step => cost_model_step                    !< collective
    procedure :: weights => cost_model_weights
    procedure :: costs => cost_model_costs
    procedure :: uses_costs => cost_model_uses_costs
    procedure :: report => cost_model_report
  end type

  public :: rrcb_cut, rrcb_report, rrcb_version, rrcb_build_info, rrcb_last_error

contains

  function text_of(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    call c_f_pointer(address, letters, [c_strlen(address)])
    allocate (character(size(letters)) :: text)
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function

  !> Version of the library, as "major.minor.patch".
  function rrcb_version() result(text)
    character(:), allocatable :: text
    text = text_of(c_version())
  end function

  !> What the library was built from and with.
  function rrcb_build_info() result(text)
    character(:), allocatable :: text
    text = text_of(c_build_info())
  end function

  !> What the last procedure that failed on this thread has to say.
  function rrcb_last_error() result(text)
    character(:), allocatable :: text
    text = text_of(c_last_error())
  end function

  subroutine balancer_create(self, comm, error)
    class(rrcb_balancer), intent(inout) :: self
    integer, intent(in) :: comm
    integer, intent(out) :: error
    error = c_create(int(comm, c_int), self%handle)
  end subroutine

  subroutine balancer_free(self)
    class(rrcb_balancer), intent(inout) :: self
    call c_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  subroutine balancer_set(self, option, value, error)
    class(rrcb_balancer), intent(inout) :: self
    character(*), intent(in) :: option, value
    integer, intent(out) :: error
    error = c_set(self%handle, option//c_null_char, value//c_null_char)
  end subroutine

  subroutine balancer_set_part_sizes(self, sizes, error)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in) :: sizes(:)
    integer, intent(out) :: error
    error = c_set_part_sizes(self%handle, size(sizes, kind=c_size_t), sizes)
  end subroutine

  !> `parts` has an entry for each point; so has `weights`, or every point weighs 1.
  subroutine balancer_balance(self, coordinates, parts, error, weights)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in), contiguous :: coordinates(:, :)
    integer(c_int32_t), intent(out), contiguous :: parts(:)
    integer, intent(out) :: error
    real(c_double), intent(in), target, contiguous, optional :: weights(:)
    error = c_balance(self%handle, size(coordinates, 1, c_int), size(parts, kind=c_size_t), &
                      coordinates, address_of(weights), parts)
  end subroutine

  !> The same from the cuts that the balancer has, for points that moved little since.
  subroutine balancer_rebalance(self, coordinates, parts, error, weights)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in), contiguous :: coordinates(:, :)
    integer(c_int32_t), intent(out), contiguous :: parts(:)
    integer, intent(out) :: error
    real(c_double), intent(in), target, contiguous, optional :: weights(:)
    error = c_rebalance(self%handle, size(coordinates, 1, c_int), size(parts, kind=c_size_t), &
                        coordinates, address_of(weights), parts)
  end subroutine

  function address_of(weights) result(address)
    real(c_double), intent(in), target, contiguous, optional :: weights(:)
    type(c_ptr) :: address
    address = c_null_ptr
    if (.not. present(weights)) return
    if (size(weights) > 0) address = c_loc(weights)
  end function

  subroutine balancer_get_report(self, report, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_report), intent(inout) :: report
    integer, intent(out) :: error
    error = c_get_report(self%handle, report)
  end subroutine

  !> The cuts belong to the balancer until it gets others. An error before the first, with
  !> `dimension` 0, and if the balancer holds a part of them only. set_cuts takes them
  !> back with their `group_size`, 1 by default; an error if it is another and not asked for.
  subroutine balancer_get_cuts(self, dimension, cuts, error, group_size)
    class(rrcb_balancer), intent(in) :: self
    integer, intent(out) :: dimension
    type(rrcb_cut), pointer, intent(out) :: cuts(:)
    integer, intent(out) :: error
    integer, intent(out), optional :: group_size
    type(c_cuts) :: from
    error = c_get_cuts(self%handle, from)
    dimension = from%dimension
    if (present(group_size)) then
      group_size = from%group_size
    else if (error == rrcb_ok .and. from%group_size /= 1) then
      error = rrcb_invalid_argument
    end if
    call c_f_pointer(from%tree, cuts, [from%num_parts - 1])
  end subroutine

  !> Gives each rank's balancer all cuts, where each holds a part of them.
  subroutine balancer_gather_cuts(self, error)
    class(rrcb_balancer), intent(inout) :: self
    integer, intent(out) :: error
    error = c_gather_cuts(self%handle)
  end subroutine

  !> Copies cuts of an earlier run, one less than there are parts.
  subroutine balancer_set_cuts(self, dimension, cuts, error, group_size)
    class(rrcb_balancer), intent(inout) :: self
    integer, intent(in) :: dimension
    type(rrcb_cut), intent(in), target, contiguous :: cuts(:)
    integer, intent(out) :: error
    integer, intent(in), optional :: group_size
    type(c_cuts) :: given
    given = c_cuts(int(dimension, c_int), size(cuts) + 1, c_null_ptr)
    if (present(group_size)) given%group_size = int(group_size, c_int)
    if (size(cuts) > 0) given%tree = c_loc(cuts)
    error = c_set_cuts(self%handle, given)
  end subroutine

  subroutine balancer_assign(self, coordinates, parts, error)
    class(rrcb_balancer), intent(in) :: self
    real(c_double), intent(in), contiguous :: coordinates(:, :)
    integer(c_int32_t), intent(out), contiguous :: parts(:)
    integer, intent(out) :: error
    error = c_assign(self%handle, size(parts, kind=c_size_t), coordinates, parts)
  end subroutine

  !> The same wherever the cuts are held.
  subroutine balancer_assign_all(self, coordinates, parts, error)
    class(rrcb_balancer), intent(in) :: self
    real(c_double), intent(in), contiguous :: coordinates(:, :)
    integer(c_int32_t), intent(out), contiguous :: parts(:)
    integer, intent(out) :: error
    error = c_assign_all(self%handle, size(parts, kind=c_size_t), coordinates, parts)
  end subroutine

  subroutine balancer_box_of(self, part, lower, upper, error)
    class(rrcb_balancer), intent(in) :: self
    integer(c_int32_t), intent(in) :: part
    real(c_double), intent(out) :: lower(3), upper(3)
    integer, intent(out) :: error
    error = c_box_of(self%handle, part, lower, upper)
  end subroutine

  subroutine balancer_make_plan(self, parts, error)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int32_t), intent(in), contiguous :: parts(:)
    integer, intent(out) :: error
    error = c_make_plan(self%handle, size(parts, kind=c_size_t), parts)
  end subroutine

  subroutine balancer_get_plan(self, plan, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_plan), intent(inout) :: plan
    integer, intent(out) :: error
    type(c_plan) :: from
    error = c_get_plan(self%handle, from)
    plan%num_points = from%num_points
    plan%num_points_after = from%num_points_after
    call c_f_pointer(from%export_indices, plan%export_indices, [from%num_exports])
    call c_f_pointer(from%export_ranks, plan%export_ranks, [from%num_exports])
    call c_f_pointer(from%export_parts, plan%export_parts, [from%num_exports])
    call c_f_pointer(from%import_ranks, plan%import_ranks, [from%num_imports])
    call c_f_pointer(from%import_indices, plan%import_indices, [from%num_imports])
    call c_f_pointer(from%import_parts, plan%import_parts, [from%num_imports])
  end subroutine

  subroutine balancer_transfer_reals(self, from, to, error)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in), target, contiguous :: from(:)
    real(c_double), intent(inout), target, contiguous :: to(:)
    integer, intent(out) :: error
    error = c_transfer(self%handle, c_sizeof(0.0_c_double), c_loc(from), c_loc(to))
  end subroutine

  !> A column of vectors: shapes (components, points).
  subroutine balancer_transfer_vectors(self, from, to, error)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in), target, contiguous :: from(:, :)
    real(c_double), intent(inout), target, contiguous :: to(:, :)
    integer, intent(out) :: error
    error = c_transfer(self%handle, size(from, 1)*c_sizeof(0.0_c_double), c_loc(from), c_loc(to))
  end subroutine

  subroutine balancer_transfer_integers(self, from, to, error)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int32_t), intent(in), target, contiguous :: from(:)
    integer(c_int32_t), intent(inout), target, contiguous :: to(:)
    integer, intent(out) :: error
    error = c_transfer(self%handle, c_sizeof(0_c_int32_t), c_loc(from), c_loc(to))
  end subroutine

  subroutine balancer_transfer_long_integers(self, from, to, error)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int64_t), intent(in), target, contiguous :: from(:)
    integer(c_int64_t), intent(inout), target, contiguous :: to(:)
    integer, intent(out) :: error
    error = c_transfer(self%handle, c_sizeof(0_c_int64_t), c_loc(from), c_loc(to))
  end subroutine

  subroutine controller_create(self, comm, error)
    class(rrcb_controller), intent(inout) :: self
    integer, intent(in) :: comm
    integer, intent(out) :: error
    error = c_controller_create(int(comm, c_int), self%handle)
  end subroutine

  subroutine controller_free(self)
    class(rrcb_controller), intent(inout) :: self
    call c_controller_destroy(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> With the points of this rank, or the sum of their weights, the load is smoothed.
  subroutine controller_step(self, load, error, points)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: load
    integer, intent(out) :: error
    real(c_double), intent(in), optional :: points
    integer(c_int) :: due
    if (present(points)) then
      error = c_controller_step_points(self%handle, load, points, due)
    else
      error = c_controller_step(self%handle, load, due)
    end if
  end subroutine

  !> Whether to rebalance before the next step; false for a controller that was not created.
  function controller_due(self) result(due)
    class(rrcb_controller), intent(in) :: self
    logical :: due
    integer(c_int) :: answer
    answer = 0
    due = c_controller_due(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  subroutine controller_rebalanced(self, cost, error, report)
    class(rrcb_controller), intent(inout) :: self
    real(c_double), intent(in) :: cost
    integer, intent(out) :: error
    type(rrcb_report), intent(in), target, optional :: report
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(report)) address = c_loc(report)
    error = c_controller_rebalanced(self%handle, address, cost)
  end subroutine

  !> Its sums travel with the steps of `controller`, which has recorded none and is freed later.
  subroutine cost_model_create(self, comm, num_columns, error, controller)
    class(rrcb_cost_model), intent(inout) :: self
    integer, intent(in) :: comm, num_columns
    integer, intent(out) :: error
    class(rrcb_controller), intent(in), optional :: controller
    type(c_ptr) :: steps
    steps = c_null_ptr
    if (present(controller)) steps = controller%handle
    error = c_cost_model_create(int(comm, c_int), steps, int(num_columns, c_int), self%handle)
  end subroutine

  subroutine cost_model_free(self)
    class(rrcb_cost_model), intent(inout) :: self
    call c_cost_model_destroy(self%handle)
    self%handle = c_null_ptr
  end subroutine

  subroutine cost_model_step(self, seconds, columns, error)
    class(rrcb_cost_model), intent(inout) :: self
    real(c_double), intent(in) :: seconds
    real(c_double), intent(in), contiguous :: columns(:)
    integer, intent(out) :: error
    error = c_cost_model_step(self%handle, seconds, size(columns, kind=c_size_t), columns)
  end subroutine

  !> `columns` has the shape (columns, points), `weights` an entry for each point.
  subroutine cost_model_weights(self, columns, weights, error)
    class(rrcb_cost_model), intent(inout) :: self
    real(c_double), intent(in), contiguous :: columns(:, :)
    real(c_double), intent(out), contiguous :: weights(:)
    integer, intent(out) :: error
    error = c_cost_model_weights(self%handle, size(weights, kind=c_size_t), &
      size(columns, 1, kind=c_size_t), columns, weights)
  end subroutine

  !> `costs` has an entry for each column.
  subroutine cost_model_costs(self, costs, error)
    class(rrcb_cost_model), intent(in) :: self
    real(c_double), intent(inout), contiguous :: costs(:)
    integer, intent(out) :: error
    error = c_cost_model_costs(self%handle, costs)
  end subroutine

  !> Whether weights are by the costs; false for a model that was not created.
  function cost_model_uses_costs(self) result(uses_costs)
    class(rrcb_cost_model), intent(in) :: self
    logical :: uses_costs
    integer(c_int) :: answer
    answer = 0
    uses_costs = c_cost_model_uses_costs(self%handle, answer) == rrcb_ok .and. answer == 1
  end function

  !> Whether costs are used and why, in a sentence.
  function cost_model_report(self) result(text)
    class(rrcb_cost_model), intent(in) :: self
    character(:), allocatable :: text
    text = text_of(c_cost_model_report(self%handle))
  end function

end module rrcb
