!> Points that ranks need from each other.
module rrcb_ghost_lists
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_functions
  use rrcb_functions, only: settle
  use rrcb_balancers
  implicit none
  private
  public :: copy_lists

  !> Value of needs for radii that do not fit the points, see src/c/ghosts_mpi.cpp; the call fails
  !> on all ranks.
  integer(c_int), parameter :: wrong_radii = -1

  !> Ghosts. A copy refers to the same ghosts, so destroy only one of them.
  type, public :: rrcb_ghosts
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
  contains
    procedure :: create
    procedure :: destroy
    procedure :: get_plan
    procedure :: fetch
    procedure :: reply
    procedure :: accumulate
    generic :: apply_shifts => shift_doubles, shift_reals, shift_points
    procedure, private :: shift_doubles, shift_reals, shift_points
  end type

contains

  !> Finds from the cuts the points that other ranks need. Collective.
  !> @param balancer       to whose ranks the points were transferred
  !> @param points         of this rank, after transfer. The points of the balance or of assign_all are
  !> refused if one of them has yet to leave its rank
  !> @param cutoff         cut-off cutoff of all points
  !> @param cutoffs          one for each point instead
  !> @param lower          lower end of a periodic box
  !> @param upper          upper end of the box
  !> @param ranks_of_parts the ranks of part p at p + 1; by default those of rrcb_ranks_of_part
  !> @param needs          whose radii count: rrcb_needs_scatter by default, _gather or _symmetric
  subroutine create(self, balancer, points, error, cutoff, cutoffs, lower, upper, ranks_of_parts, needs)
    class(rrcb_ghosts), intent(inout), target :: self
    class(rrcb_balancer), intent(in) :: balancer
    type(rrcb_points), intent(in) :: points
    integer, intent(out), optional :: error
    real(c_double), intent(in), optional :: cutoff
    real(c_double), intent(in), target, contiguous, optional :: cutoffs(:)
    real(c_double), intent(in), target, optional :: lower(3), upper(3)
    type(rrcb_rank_range), intent(in), target, contiguous, optional :: ranks_of_parts(:)
    integer(c_int), intent(in), optional :: needs
    type(c_ghost_options) :: options
    if (present(needs)) options%needs = needs
    if (present(cutoff)) options%cutoff = cutoff
    if (present(lower)) options%lower = c_loc(lower)
    if (present(upper)) options%upper = c_loc(upper)
    if (present(ranks_of_parts)) then
      options%ranks_of_parts = c_loc(ranks_of_parts)
      options%num_parts = size(ranks_of_parts, kind=c_size_t)
    end if
    if (present(cutoffs)) then
      if (.not. present(cutoff)) options%cutoff = 0
      if (size(cutoffs) > 0) options%cutoffs = c_loc(cutoffs)
      if (size(cutoffs, kind=c_size_t) /= points%count) then
        options%needs = wrong_radii
        options%num_parts = size(cutoffs, kind=c_size_t)
      end if
    end if
    call settle(c_ghosts_create(balancer%handle, points, options, room_for(self%handle)), error)
  end subroutine

  !> Frees the ghosts. Not collective.
  subroutine destroy(self)
    class(rrcb_ghosts), intent(inout) :: self
    call c_ghosts_destroy(self%handle)
  end subroutine

  !> Copies the lists. Not collective.
  subroutine get_plan(self, plan, error)
    class(rrcb_ghosts), intent(in) :: self
    type(rrcb_ghost_plan), intent(inout) :: plan
    integer, intent(out), optional :: error
    type(c_ghost_plan) :: from
    call settle(c_ghosts_get_plan(self%handle, from), error)
    call copy_lists(from, plan)
  end subroutine

  !> Copies the lists that the function in C returns.
  subroutine copy_lists(from, plan)
    type(c_ghost_plan), intent(in) :: from
    type(rrcb_ghost_plan), intent(inout) :: plan
    type(c_rank_count), pointer :: send(:), receive(:)
    call c_f_pointer(from%send, send, [from%num_send_ranks])
    call c_f_pointer(from%receive, receive, [from%num_receive_ranks])
    plan%num_points = from%num_points
    plan%num_ghosts = from%num_ghosts
    plan%send_ranks = send%rank
    plan%send_counts = send%count
    plan%send_indices = indices_at(from%send_indices, from%num_sent)
    plan%receive_ranks = receive%rank
    plan%receive_counts = receive%count
    if (allocated(plan%shifts)) deallocate (plan%shifts)
    if (c_associated(from%shifts)) &
      plan%shifts = reshape(numbers_at(from%shifts, 3*from%num_ghosts), [3_c_size_t, from%num_ghosts])
  end subroutine

  !> Fetches columns of the ghosts from those of the points. Collective.
  !> @param columns the same in the same order on every rank
  !> @param max_bytes  maximum bytes of messages on each rank, the same on every rank
  !> @param report  gets memory and messages
  subroutine fetch(self, columns, error, max_bytes, report)
    class(rrcb_ghosts), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(inout), target, optional :: report
    type(c_ghost_plan) :: plan
    integer(c_int) :: code
    code = c_ghosts_get_plan(self%handle, plan)
    call settle(c_ghosts_fetch(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, plan%num_points, plan%num_ghosts), transfer_options(max_bytes, report)), error)
  end subroutine

  !> Fetches rows that the ranks of the ghosts send back: `from` has an entry for each ghost, `to`
  !> gets one for each entry of send_indices of the plan. Collective.
  !> @param columns the same in the same order on every rank
  !> @param max_bytes  maximum bytes of messages on each rank, the same on every rank
  !> @param report  gets memory and messages
  subroutine reply(self, columns, error, max_bytes, report)
    class(rrcb_ghosts), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(inout), target, optional :: report
    type(c_ghost_plan) :: plan
    integer(c_int) :: code
    code = c_ghosts_get_plan(self%handle, plan)
    call settle(c_ghosts_reply(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, plan%num_ghosts, plan%num_sent), transfer_options(max_bytes, report)), error)
  end subroutine

  !> Adds columns of the ghosts, `from`, to those of their points, `to`. Collective.
  !> @param columns the same in the same order on every rank
  !> @param max_bytes  maximum bytes of messages on each rank, the same on every rank
  !> @param report  gets memory and messages
  subroutine accumulate(self, columns, error, max_bytes, report)
    class(rrcb_ghosts), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(inout), target, optional :: report
    type(c_ghost_plan) :: plan
    integer(c_int) :: code
    code = c_ghosts_get_plan(self%handle, plan)
    call settle(c_ghosts_accumulate(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, plan%num_ghosts, plan%num_points), transfer_options(max_bytes, report)), error)
  end subroutine

  !> Moves fetched positions to those of the images: positions(dimension, ghosts). Not collective.
  subroutine shift_doubles(self, positions, error)
    class(rrcb_ghosts), intent(in) :: self
    real(c_double), intent(inout), target, contiguous :: positions(:, :)
    integer, intent(out), optional :: error
    call self%apply_shifts(rrcb_interleaved_points(positions), error)
  end subroutine

  !> Moves positions of real(4) in the same way.
  subroutine shift_reals(self, positions, error)
    class(rrcb_ghosts), intent(in) :: self
    real(c_float), intent(inout), target, contiguous :: positions(:, :)
    integer, intent(out), optional :: error
    call self%apply_shifts(rrcb_interleaved_points(positions), error)
  end subroutine

  !> Moves positions in columns or in derived types, whose arrays are changed, in the same way.
  subroutine shift_points(self, positions, error)
    class(rrcb_ghosts), intent(in) :: self
    type(rrcb_points), intent(in) :: positions
    integer, intent(out), optional :: error
    call settle(c_ghosts_apply_shifts(self%handle, positions), error)
  end subroutine

end module rrcb_ghost_lists
