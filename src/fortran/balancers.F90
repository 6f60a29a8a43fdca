!> A balancer: it contains a communicator, options, cuts and a plan.
module rrcb_balancers
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_types
  use rrcb_c_functions
  use rrcb_functions, only: save_by, settle, three_of
#ifdef RRCB_MPI_F08
  use mpi_f08, only: MPI_Comm
#endif
  implicit none
  private

  !> A balancer. A copy refers to the same balancer, so destroy only one of them.
  type, public :: rrcb_balancer
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
  contains
    procedure, private :: create_by_number
#ifdef RRCB_MPI_F08
    procedure, private :: create_by_type
    generic :: create => create_by_type
#endif
    generic :: create => create_by_number
    procedure :: destroy
    procedure :: set
    procedure :: set_part_sizes
    procedure :: balance
    procedure :: release_buffers
    procedure :: get_report
    procedure :: get_cuts
    procedure :: set_cuts
    procedure :: clear_cuts
    procedure :: save_cuts
    procedure :: load_cuts
    procedure :: part_of
    procedure :: assign
    procedure :: assign_all
    procedure :: box_of
    procedure :: parts_touching
    procedure :: plan => make_plan
    procedure :: get_plan
    procedure :: transfer => transfer_columns
    procedure :: remap
    procedure :: part_weights
    procedure :: moved_fraction
  end type

contains

  !> Makes a balancer. Collective over the communicator, which must outlive it.
  subroutine create_by_number(self, comm, error)
    class(rrcb_balancer), intent(inout), target :: self
    integer, intent(in) :: comm
    integer, intent(out), optional :: error
    call settle(c_create(int(comm, c_int), room_for(self%handle)), error)
  end subroutine

#ifdef RRCB_MPI_F08
  !> Does the same with the type of `use mpi_f08`.
  subroutine create_by_type(self, comm, error)
    class(rrcb_balancer), intent(inout) :: self
    type(MPI_Comm), intent(in) :: comm
    integer, intent(out), optional :: error
    call self%create(comm%mpi_val, error)
  end subroutine
#endif

  !> Frees the balancer. Not collective.
  subroutine destroy(self)
    class(rrcb_balancer), intent(inout) :: self
    call c_destroy(self%handle)
  end subroutine

  !> Sets an option, such as ("refine", "EXACT"). It must be the same on all ranks. Not collective.
  !> @param option its name in rrcb::Options
  !> @param value  as docs/parameters.md lists them
  subroutine set(self, option, value, error)
    class(rrcb_balancer), intent(inout) :: self
    character(*), intent(in) :: option, value
    integer, intent(out), optional :: error
    call settle(c_set(self%handle, trim(option)//c_null_char, trim(value)//c_null_char), error)
  end subroutine

  !> Sets the relative weights of the parts, which must be the same on all ranks. Not collective.
  subroutine set_part_sizes(self, sizes, error)
    class(rrcb_balancer), intent(inout) :: self
    real(c_double), intent(in), contiguous :: sizes(:)
    integer, intent(out), optional :: error
    call settle(c_set_part_sizes(self%handle, size(sizes, kind=c_size_t), sizes), error)
  end subroutine

  !> Divides the points of all ranks into parts. Starts from the cuts of the balancer, if it has
  !> any, and keeps the new ones. Collective. Call clear_cuts before, if the option refine is NONE,
  !> if the dimension has changed, or if num_parts has changed and is not 0.
  !> @param points of this rank
  !> @param parts  gets the new part of each
  subroutine balance(self, points, parts, error)
    class(rrcb_balancer), intent(inout) :: self
    type(rrcb_points), intent(in) :: points
    integer(c_int32_t), intent(inout), target, contiguous :: parts(:)
    integer, intent(out), optional :: error
    call settle(c_balance(self%handle, points, place_of(parts, points%count)), error)
  end subroutine

  !> Frees the buffers that calls on the communicator keep. Not collective.
  subroutine release_buffers(self, error)
    class(rrcb_balancer), intent(inout) :: self
    integer, intent(out), optional :: error
    call settle(c_release_buffers(self%handle), error)
  end subroutine

  !> Copies the report of the last balance. Not collective.
  subroutine get_report(self, report, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_report), intent(inout) :: report
    integer, intent(out), optional :: error
    call settle(c_get_report(self%handle, report), error)
  end subroutine

  !> Copies the cuts. Not collective. Fails before the first balance.
  subroutine get_cuts(self, cuts, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_cuts), intent(inout) :: cuts
    integer, intent(out), optional :: error
    type(c_cuts) :: from
    type(rrcb_cut), pointer :: tree(:)
    integer(c_int32_t), pointer :: numbers(:)
    call settle(c_get_cuts(self%handle, from), error)
    call c_f_pointer(from%tree, tree, [from%num_parts - 1])
    cuts = rrcb_cuts(from%dimension, from%group_size, from%round_robin_block, from%larger_below == 1, tree, &
                     debt=from%debt)
    cuts%tree%axis = cuts%tree%axis + 1
    if (.not. c_associated(from%numbers)) return
    call c_f_pointer(from%numbers, numbers, [from%num_parts])
    cuts%numbers = numbers
  end subroutine

  !> Copies cuts of an earlier run into the balancer. Not collective.
  subroutine set_cuts(self, cuts, error)
    class(rrcb_balancer), intent(inout) :: self
    type(rrcb_cuts), intent(in) :: cuts
    integer, intent(out), optional :: error
    type(rrcb_cut), allocatable, target :: tree(:)
    integer(c_int32_t), allocatable, target :: numbers(:)
    type(c_cuts), target :: given
    allocate (tree(0))
    if (allocated(cuts%tree)) tree = cuts%tree
    tree%axis = tree%axis - 1
    given = c_cuts(dimension=cuts%dimension, num_parts=size(tree) + 1, group_size=cuts%group_size, &
                   larger_below=merge(1, 0, cuts%larger_below), round_robin_block=cuts%round_robin_block, debt=cuts%debt)
    if (size(tree) > 0) given%tree = c_loc(tree)
    if (allocated(cuts%numbers)) then
      numbers = cuts%numbers
      if (size(numbers) == size(tree) + 1) given%numbers = c_loc(numbers)
    end if
    call settle(c_set_cuts(self%handle, c_loc(given)), error)
  end subroutine

  !> Forgets the cuts: the next balance starts from scratch. Not collective, but on all ranks.
  subroutine clear_cuts(self, error)
    class(rrcb_balancer), intent(inout) :: self
    integer, intent(out), optional :: error
    call settle(c_set_cuts(self%handle, c_null_ptr), error)
  end subroutine

  !> Returns the cuts as bytes. Not collective.
  subroutine save_cuts(self, bytes, error)
    class(rrcb_balancer), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: error
    call save_by(c_save_cuts, self%handle, bytes, error)
  end subroutine

  !> Copies cuts from saved bytes into the balancer. Not collective.
  !> @param bytes of save_cuts
  subroutine load_cuts(self, bytes, error)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: error
    call settle(c_load_cuts(self%handle, bytes, size(bytes, kind=c_size_t)), error)
  end subroutine

  !> Finds the part of a position. Not collective.
  !> @param position an entry for each axis
  !> @param part     gets its part
  subroutine part_of(self, position, part, error)
    class(rrcb_balancer), intent(in) :: self
    real(c_double), intent(in) :: position(:)
    integer(c_int32_t), intent(inout) :: part
    integer, intent(out), optional :: error
    call settle(c_part_of(self%handle, three_of(position), part), error)
  end subroutine

  !> Finds the parts of points by the cuts of this rank. Not collective.
  !> @param points any positions
  !> @param parts  gets the part of each
  subroutine assign(self, points, parts, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_points), intent(in) :: points
    integer(c_int32_t), intent(inout), target, contiguous :: parts(:)
    integer, intent(out), optional :: error
    call settle(c_assign(self%handle, points, place_of(parts, points%count)), error)
  end subroutine

  !> Finds the parts of points; if one rank fails, all fail in the same way. Collective.
  !> @param points any positions
  !> @param parts  gets the part of each
  subroutine assign_all(self, points, parts, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_points), intent(in) :: points
    integer(c_int32_t), intent(inout), target, contiguous :: parts(:)
    integer, intent(out), optional :: error
    call settle(c_assign_all(self%handle, points, place_of(parts, points%count)), error)
  end subroutine

  !> Finds the region of a part; sides without a cut are infinite. Not collective.
  !> @param part  from 0
  !> @param lower gets the lower end
  !> @param upper gets the upper end
  subroutine box_of(self, part, lower, upper, error)
    class(rrcb_balancer), intent(in) :: self
    integer(c_int32_t), intent(in) :: part
    real(c_double), intent(inout) :: lower(3), upper(3)
    integer, intent(out), optional :: error
    call settle(c_box_of(self%handle, part, lower, upper), error)
  end subroutine

  !> Finds the parts that touch a closed box. Not collective.
  !> @param lower lower end of the box, an entry for each axis
  !> @param upper upper end of the box
  !> @param parts gets their numbers, ascending
  subroutine parts_touching(self, lower, upper, parts, error)
    class(rrcb_balancer), intent(in) :: self
    real(c_double), intent(in) :: lower(:), upper(:)
    integer(c_int32_t), allocatable, intent(inout) :: parts(:)
    integer, intent(out), optional :: error
    integer(c_size_t) :: count
    integer(c_int) :: code
    count = 16
    do
      parts = spread(0_c_int32_t, 1, count)
      code = c_parts_touching(self%handle, three_of(lower), three_of(upper), &
                              size(parts, kind=c_size_t), parts, count)
      if (code /= rrcb_ok) count = 0
      if (count <= size(parts)) exit
    end do
    parts = parts(:count)
    call settle(code, error)
  end subroutine

  !> Makes the plan of a move into the given parts, one for each point. Fails if there are fewer
  !> points than were balanced, or assigned since. Collective.
  subroutine make_plan(self, parts, error)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int32_t), intent(in), contiguous :: parts(:)
    integer, intent(out), optional :: error
    call settle(c_make_plan(self%handle, size(parts, kind=c_size_t), parts), error)
  end subroutine

  !> Copies the lists of the plan. Not collective.
  subroutine get_plan(self, plan, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_plan_lists), intent(inout) :: plan
    integer, intent(out), optional :: error
    type(c_plan) :: from
    call settle(c_get_plan(self%handle, from), error)
    plan%num_points = from%num_points
    plan%num_points_after = from%num_points_after
    plan%export_indices = indices_at(from%export_indices, from%num_exports)
    plan%export_ranks = numbers_at(from%export_ranks, from%num_exports)
    plan%export_parts = numbers_at(from%export_parts, from%num_exports)
    plan%import_indices = indices_at(from%import_indices, from%num_imports)
    plan%import_ranks = numbers_at(from%import_ranks, from%num_imports)
    plan%import_parts = numbers_at(from%import_parts, from%num_imports)
  end subroutine

  !> Moves columns along the plan: the points that stay come first, then those that arrive.
  !> Collective.
  !> @param columns the same in the same order on every rank
  !> @param max_bytes  maximum bytes of messages on each rank, the same on every rank
  !> @param report  gets memory and messages
  subroutine transfer_columns(self, columns, error, max_bytes, report)
    class(rrcb_balancer), intent(inout) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(inout), target, optional :: report
    type(c_plan) :: plan
    integer(c_int) :: code
    code = c_get_plan(self%handle, plan)
    call settle(c_transfer(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, plan%num_points, plan%num_points_after), transfer_options(max_bytes, report)), error)
  end subroutine

  !> Numbers the parts of the cuts so that many points stay. Collective.
  !> @param parts          the new part of each point
  !> @param numbers        numbers(p + 1) gets the new number of part p
  !> @param previous       the part that each point was in; without it points should stay on their ranks
  !> @param ranks_of_parts the ranks of part p at p + 1; by default those of rrcb_ranks_of_part
  !> @param report         gets how many points stay
  subroutine remap(self, parts, numbers, error, previous, ranks_of_parts, report)
    class(rrcb_balancer), intent(inout) :: self
    integer(c_int32_t), intent(in), target, contiguous :: parts(:)
    integer(c_int32_t), intent(inout), contiguous :: numbers(:)
    integer, intent(out), optional :: error
    integer(c_int32_t), intent(in), contiguous, optional :: previous(:)
    type(rrcb_rank_range), intent(in), contiguous, optional :: ranks_of_parts(:)
    type(rrcb_remap_report), intent(inout), optional :: report
    type(c_ptr) :: now
    integer(c_size_t) :: num_parts
    now = place_of(parts, size(parts, kind=c_size_t))
    if (present(previous)) then
      if (size(previous) /= size(parts)) now = c_null_ptr
    end if
    num_parts = size(numbers, kind=c_size_t)
    if (present(ranks_of_parts)) num_parts = min(num_parts, size(ranks_of_parts, kind=c_size_t))
    call settle(c_remap(self%handle, size(parts, kind=c_size_t), now, previous, ranks_of_parts, &
      num_parts, numbers, report), error)
  end subroutine

  !> Adds up the weights of each part over all ranks. Collective.
  !> @param points  of this rank
  !> @param parts   the part of each
  !> @param weights weights(p + 1) gets that of part p
  subroutine part_weights(self, points, parts, weights, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_points), intent(in) :: points
    integer(c_int32_t), intent(in), target, contiguous :: parts(:)
    real(c_double), intent(inout), contiguous :: weights(:)
    integer, intent(out), optional :: error
    call settle(c_part_weights(self%handle, points, place_of(parts, points%count), &
      size(weights, kind=c_size_t), weights), error)
  end subroutine

  !> Finds which share of the weight has to move to another rank. Collective.
  !> @param points   of this rank
  !> @param parts    the new part of each
  !> @param fraction gets the share, from 0 to 1
  subroutine moved_fraction(self, points, parts, fraction, error)
    class(rrcb_balancer), intent(in) :: self
    type(rrcb_points), intent(in) :: points
    integer(c_int32_t), intent(in), target, contiguous :: parts(:)
    real(c_double), intent(inout) :: fraction
    integer, intent(out), optional :: error
    call settle(c_moved_fraction(self%handle, points, place_of(parts, points%count), fraction), error)
  end subroutine

end module rrcb_balancers
