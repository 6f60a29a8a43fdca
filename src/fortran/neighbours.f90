!> Exchanges with the ranks near this one.
module rrcb_neighbour_lists
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_types
  use rrcb_c_functions
  use rrcb_c_neighbours
  use rrcb_functions, only: settle
  use rrcb_arrays
  use rrcb_balancers
  use rrcb_ghost_lists, only: copy_lists
  implicit none
  private

  !> Neighbours. Their procedures wait only for neighbours. If one fails on a rank, it fails on the
  !> neighbours in the same call, and on their neighbours in the next one; then all ranks must
  !> destroy these and create others. A copy refers to the same neighbours, so destroy only one of
  !> them.
  type, public :: rrcb_neighbours
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
  contains
    procedure :: create
    procedure :: destroy
    procedure :: migrate
    procedure :: find_ghosts
    procedure :: fetch
    procedure :: accumulate
    procedure :: sum => sum_shared
    procedure :: ghost_plan
    procedure :: ranks
    generic :: apply_shifts => shift_doubles, shift_reals, shift_points
    procedure, private :: shift_doubles, shift_reals, shift_points
  end type

contains

  !> Finds the neighbours from the cuts. Collective.
  !> @param balancer       with all cuts
  !> @param cutoff         cut-off cutoff of ghosts, the largest of all cutoffs
  !> @param travel         distance that a point may move between two calls of migrate
  !> @param lower          lower end of a periodic box
  !> @param upper          upper end of the box
  !> @param ranks_of_parts the ranks of part p at p + 1; by default those of rrcb_ranks_of_part
  !> @param needs          whose radii count: rrcb_needs_scatter by default, _gather or _symmetric
  subroutine create(self, balancer, error, cutoff, travel, lower, upper, ranks_of_parts, needs)
    class(rrcb_neighbours), intent(inout), target :: self
    class(rrcb_balancer), intent(in) :: balancer
    integer, intent(out), optional :: error
    real(c_double), intent(in), optional :: cutoff, travel
    real(c_double), intent(in), target, optional :: lower(3), upper(3)
    type(rrcb_rank_range), intent(in), target, contiguous, optional :: ranks_of_parts(:)
    integer(c_int), intent(in), optional :: needs
    type(c_neighbour_options) :: options
    if (present(cutoff)) options%cutoff = cutoff
    if (present(travel)) options%travel = travel
    if (present(needs)) options%needs = needs
    if (present(lower)) options%lower = c_loc(lower)
    if (present(upper)) options%upper = c_loc(upper)
    if (present(ranks_of_parts)) then
      options%ranks_of_parts = c_loc(ranks_of_parts)
      options%num_parts = size(ranks_of_parts, kind=c_size_t)
    end if
    call settle(c_neighbours_create(balancer%handle, options, room_for(self%handle)), error)
  end subroutine

  !> Frees the neighbours. Not collective.
  subroutine destroy(self)
    class(rrcb_neighbours), intent(inout) :: self
    call c_neighbours_destroy(self%handle)
  end subroutine

  !> Sends points that have left the parts of this rank to their ranks, and takes the points that
  !> arrive.
  !> @param columns contain the arrays of all points, which are reallocated if their number changes; the
  !> first one contains positions(dimension, points)
  !> @param axes    if present, the first `axes` columns are the coordinates along one axis each
  subroutine migrate(self, columns, error, axes)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_array), intent(inout), target :: columns(:)
    integer, intent(out), optional :: error
    integer, intent(in), optional :: axes
    type(c_array) :: in_c(size(columns))
    in_c = arrays_in_c(columns)
    call settle(c_neighbours_migrate(self%handle, points_in(in_c, axes), &
      size(columns, kind=c_size_t), in_c), error)
  end subroutine

  !> Finds the points that other ranks need. Sends messages only with the radii of receivers.
  !> @param points of this rank
  !> @param cutoffs  one for each point, at most `cutoff` of create
  subroutine find_ghosts(self, points, error, cutoffs)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_points), intent(in) :: points
    integer, intent(out), optional :: error
    real(c_double), intent(in), pointer, contiguous, optional :: cutoffs(:)
    type(rrcb_points) :: checked
    checked = points
    if (present(cutoffs)) call check_number(size(cutoffs, kind=c_size_t), checked)
    call settle(c_neighbours_find_ghosts(self%handle, checked, address_of(cutoffs)), error)
  end subroutine

  !> Fetches columns of the ghosts.
  !> @param columns rrcb_column(x, x) for each column x of the points; the second x is not used
  !> @param ghosts  contain an array of the same type for each column, which is reallocated for the ghosts
  subroutine fetch(self, columns, ghosts, error)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    type(rrcb_array), intent(inout), target :: ghosts(:)
    integer, intent(out), optional :: error
    type(c_array) :: in_c(size(ghosts))
    type(c_ptr) :: from(size(columns))
    type(c_ghost_plan) :: plan
    integer(c_int) :: code
    integer :: k
    in_c = arrays_in_c(ghosts)
    from = c_null_ptr
    code = c_neighbours_ghost_plan(self%handle, plan)
    do k = 1, min(size(columns), size(ghosts))
      if (columns(k)%type /= in_c(k)%type .or. columns(k)%components /= in_c(k)%components) cycle
      if (columns(k)%num_from >= plan%num_points) from(k) = columns(k)%from
    end do
    call settle(c_neighbours_fetch(self%handle, size(columns, kind=c_size_t), from, in_c), error)
  end subroutine

  !> Adds columns of the ghosts, `from`, to those of their points, `to`.
  !> @param columns the same in the same order on every rank
  subroutine accumulate(self, columns, error)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    type(c_ghost_plan) :: plan
    integer(c_int) :: code
    code = c_neighbours_ghost_plan(self%handle, plan)
    call settle(c_neighbours_accumulate(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, plan%num_ghosts, plan%num_points)), error)
  end subroutine

  !> Replaces shared entries by the sums over all ranks that list them.
  !> @param shared_ranks neighbours with entries in common, ascending
  !> @param counts       number of these entries for each
  !> @param indices      of the entries for the first rank, then for the next; in the same order there
  !> @param columns      rrcb_column(f, f) for each array f of entries, which is changed
  subroutine sum_shared(self, shared_ranks, counts, indices, columns, error)
    class(rrcb_neighbours), intent(in) :: self
    integer(c_int), intent(in) :: shared_ranks(:)
    integer(c_size_t), intent(in) :: counts(:), indices(:)
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    type(c_rank_count), target :: shared(size(shared_ranks))
    integer(c_size_t), target :: from_zero(size(indices))
    type(c_shared_entries) :: entries
    integer :: k
    shared%rank = shared_ranks
    shared%count = [(counts(min(k, size(counts))), k=1, size(shared_ranks))]
    from_zero = indices - 1
    entries%num_ranks = size(shared, kind=c_size_t)
    if (size(shared) > 0) entries%ranks = c_loc(shared)
    entries%num_indices = size(from_zero, kind=c_size_t)
    if (size(from_zero) > 0) entries%indices = c_loc(from_zero)
    call settle(c_neighbours_sum(self%handle, entries, minval([columns%num_to, huge(0_c_size_t)]), &
      size(columns, kind=c_size_t), columns_in_c(columns, 0_c_size_t, 0_c_size_t)), error)
  end subroutine

  !> Copies the lists of the ghosts. Not collective.
  subroutine ghost_plan(self, plan, error)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_ghost_plan), intent(inout) :: plan
    integer, intent(out), optional :: error
    type(c_ghost_plan) :: from
    call settle(c_neighbours_ghost_plan(self%handle, from), error)
    call copy_lists(from, plan)
  end subroutine

  !> Returns the ranks of the neighbours. Not collective.
  subroutine ranks(self, list, error)
    class(rrcb_neighbours), intent(in) :: self
    integer(c_int), allocatable, intent(inout) :: list(:)
    integer, intent(out), optional :: error
    integer(c_size_t) :: count
    type(c_ptr) :: address
    integer(c_int) :: code
    code = c_neighbours_ranks(self%handle, count, address)
    if (code == rrcb_ok) list = numbers_at(address, count)
    call settle(code, error)
  end subroutine

  !> Moves fetched positions to those of the images: positions(dimension, ghosts). Not collective.
  subroutine shift_doubles(self, positions, error)
    class(rrcb_neighbours), intent(in) :: self
    real(c_double), intent(inout), target, contiguous :: positions(:, :)
    integer, intent(out), optional :: error
    call self%apply_shifts(rrcb_interleaved_points(positions), error)
  end subroutine

  !> Moves positions of real(4) in the same way.
  subroutine shift_reals(self, positions, error)
    class(rrcb_neighbours), intent(in) :: self
    real(c_float), intent(inout), target, contiguous :: positions(:, :)
    integer, intent(out), optional :: error
    call self%apply_shifts(rrcb_interleaved_points(positions), error)
  end subroutine

  !> Moves positions in columns or in derived types, whose arrays are changed, in the same way.
  subroutine shift_points(self, positions, error)
    class(rrcb_neighbours), intent(in) :: self
    type(rrcb_points), intent(in) :: positions
    integer, intent(out), optional :: error
    call settle(c_neighbours_apply_shifts(self%handle, positions), error)
  end subroutine

end module rrcb_neighbour_lists
