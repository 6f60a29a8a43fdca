!> Groups of points that go to one part together.
module rrcb_group_lists
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_functions
  use rrcb_functions, only: settle
  use rrcb_balancers
  implicit none
  private

  !> Groups. A copy refers to the same groups, so destroy only one of them.
  type, public :: rrcb_groups
    type(c_ptr) :: handle = c_null_ptr                      !< for the library
    integer(c_size_t), private :: num_points = 0
  contains
    procedure :: create
    procedure :: destroy
    procedure :: points => points_of_groups
    procedure :: to_points
    procedure :: sums
  end type

contains

  !> Finds the groups of points with equal keys. Collective.
  !> @param balancer       whose communicator is used; its cuts are not
  !> @param points         of this rank
  !> @param keys           one for each point; -1 for a point that is in no group
  !> @param at_first_point .true.: the position of a group is that of its first point; otherwise it is its
  !> centre of weight
  subroutine create(self, balancer, points, keys, error, at_first_point)
    class(rrcb_groups), intent(inout), target :: self
    class(rrcb_balancer), intent(in) :: balancer
    type(rrcb_points), intent(in) :: points
    integer(c_int64_t), intent(in), target, contiguous :: keys(:)
    integer, intent(out), optional :: error
    logical, intent(in), optional :: at_first_point
    type(c_ptr) :: address
    integer(c_int) :: place, code
    address = c_null_ptr
    if (size(keys) > 0 .and. size(keys, kind=c_size_t) == points%count) address = c_loc(keys)
    place = 0
    if (present(at_first_point)) place = merge(1, 0, at_first_point)
    code = c_groups_create(balancer%handle, points, address, place, room_for(self%handle))
    if (code == rrcb_ok) self%num_points = points%count
    call settle(code, error)
  end subroutine

  !> Frees the groups. Not collective.
  subroutine destroy(self)
    class(rrcb_groups), intent(inout) :: self
    call c_groups_destroy(self%handle)
  end subroutine

  !> Returns the groups of this rank as points, for balance(). Not collective.
  subroutine points_of_groups(self, points, error)
    class(rrcb_groups), intent(in) :: self
    type(rrcb_points), intent(inout) :: points
    integer, intent(out), optional :: error
    call settle(c_groups_points(self%handle, points), error)
  end subroutine

  !> Fetches for each point the values of its group, for example its part. Collective.
  !> @param columns the same in the same order on every rank
  !> @param max_bytes  maximum bytes of messages on each rank, the same on every rank
  !> @param report  gets memory and messages
  subroutine to_points(self, columns, error, max_bytes, report)
    class(rrcb_groups), intent(in) :: self
    type(rrcb_column), intent(in) :: columns(:)
    integer, intent(out), optional :: error
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(inout), target, optional :: report
    type(rrcb_points) :: groups
    integer(c_int) :: code
    code = c_groups_points(self%handle, groups)
    call settle(c_groups_to_points(self%handle, size(columns, kind=c_size_t), &
      columns_in_c(columns, groups%count, self%num_points), transfer_options(max_bytes, report)), error)
  end subroutine

  !> Adds up values over the points of each group. Collective.
  !> @param values    of shape (components, points)
  !> @param of_groups gets the sums, of shape (components, groups)
  subroutine sums(self, values, of_groups, error)
    class(rrcb_groups), intent(in) :: self
    real(c_double), intent(in), target, contiguous :: values(:, :)
    real(c_double), intent(inout), target, contiguous :: of_groups(:, :)
    integer, intent(out), optional :: error
    type(rrcb_points) :: groups
    type(c_ptr) :: from, to
    integer(c_int) :: code
    code = c_groups_points(self%handle, groups)
    from = c_null_ptr
    to = c_null_ptr
    if (size(values) > 0 .and. size(values, 2, c_size_t) >= self%num_points) from = c_loc(values)
    if (size(of_groups) > 0 .and. size(of_groups, kind=c_size_t) >= size(values, 1)*groups%count) &
      to = c_loc(of_groups)
    call settle(c_groups_sums(self%handle, size(values, 1, c_size_t), from, to), error)
  end subroutine

end module rrcb_group_lists
