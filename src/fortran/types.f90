!> Types of the procedures' arguments. Points and columns are views of contiguous arrays, which must
!> have the attribute `target` and are not copied. `size` is the size of the type in bytes; do not
!> change it.
module rrcb_types
  use, intrinsic :: iso_c_binding
  implicit none
  private

  integer, parameter, public :: rrcb_ok = 0, rrcb_invalid_argument = 1, rrcb_out_of_memory = 2, &
    rrcb_mpi_error = 3, rrcb_internal_error = 4
  integer(c_int), parameter, public :: rrcb_float = 3, rrcb_double = 4
  !> Determines whose radius counts if points have different radii.
  integer(c_int), parameter, public :: rrcb_needs_scatter = 0, rrcb_needs_gather = 1, rrcb_needs_symmetric = 2
  integer(c_int), parameter, public :: type_int32 = 1, type_int64 = 2
  integer(c_int), parameter :: type_byte = 5
  !> Types for points whose arrays do not fit together, see src/c/points.cpp; calls with them fail
  !> on all ranks.
  integer(c_int), parameter :: wrong_weights = 11, wrong_axis = 12, wrong_shape = 13, wrong_radii = 14

  !> View of the points of this rank; coordinate a of point i is at axes(a) + (i - 1)*stride bytes.
  !> If your points are derived types, set axes(a) to c_loc(points(1)%x(a)), and `type` to
  !> rrcb_float if x is real(4).
  type, public, bind(c) :: rrcb_points
    integer(c_size_t) :: size = 64
    integer(c_int) :: dimension = 0, type = rrcb_double
    integer(c_size_t) :: count = 0, stride = 0
    type(c_ptr) :: axes(3) = c_null_ptr, weights = c_null_ptr
  end type

  !> A column of the points, and memory for its result, made by rrcb_column(from, to). For other
  !> types give the number of bytes of a point first: rrcb_column(c_sizeof(x(1)), c_loc(x),
  !> c_loc(to)); the lengths of such arrays are not checked.
  type, public :: rrcb_column
    integer(c_int) :: type = type_byte
    integer(c_size_t) :: components = 1
    type(c_ptr) :: from = c_null_ptr, to = c_null_ptr
    integer(c_size_t) :: num_from = huge(0_c_size_t), num_to = huge(0_c_size_t) !< points they hold
  end type

  !> A column in the form that C uses.
  type, public, bind(c) :: c_column
    integer(c_size_t) :: size = 40
    integer(c_int) :: type = type_byte
    integer(c_size_t) :: components = 1
    type(c_ptr) :: from = c_null_ptr, to = c_null_ptr
  end type

  !> One cut. Its plane is at(axis).
  type, public, bind(c) :: rrcb_cut
    integer(c_int32_t) :: axis = 1, divides = 0
    real(c_double) :: at(3) = 0
  end type

  !> The tree of cuts in preorder. It has one cut less than there are parts.
  type, public :: rrcb_cuts
    integer :: dimension = 0, group_size = 1, round_robin_block = 0
    logical :: larger_below = .false.
    type(rrcb_cut), allocatable :: tree(:)
    !> Part at each end of the tree; not allocated: the shape determines it.
    integer(c_int32_t), allocatable :: numbers(:)
    real(c_double) :: debt = 0  !< for the next balance
  end type

  !> Report of the last balance.
  type, public, bind(c) :: rrcb_report
    integer(c_size_t) :: size = 80
    real(c_double) :: imbalance = 1
    integer(c_int) :: within_tolerance = 0, kept = 0
    integer(c_int64_t) :: num_points = 0
    real(c_double) :: total_weight = 0, least_imbalance = 1, estimated_imbalance = 1
    integer(c_int64_t) :: num_cells = 0
    integer(c_int) :: rounds = 0, coincident_cuts = 0, all_weights_zero = 0, num_empty_parts = 0
  end type

  !> Lists of the points whose rank changes.
  type, public :: rrcb_plan_lists
    integer(c_size_t) :: num_points = 0, num_points_after = 0
    integer(c_size_t), allocatable :: export_indices(:), import_indices(:)
    integer(c_int), allocatable :: export_ranks(:), import_ranks(:)
    integer(c_int32_t), allocatable :: export_parts(:), import_parts(:)
  end type

  !> Lists of the points sent and received as ghosts; shifts(axis, ghost) are those of a periodic
  !> box.
  type, public :: rrcb_ghost_plan
    integer(c_size_t) :: num_points = 0, num_ghosts = 0
    integer(c_int), allocatable :: send_ranks(:), receive_ranks(:)
    integer(c_size_t), allocatable :: send_counts(:), receive_counts(:), send_indices(:)
    integer(c_int32_t), allocatable :: shifts(:, :)
  end type

  !> Consecutive ranks that hold a part.
  type, public, bind(c) :: rrcb_rank_range
    integer(c_int) :: first_rank = 0, count = 1
  end type

  !> Memory and messages of a call on this rank.
  type, public, bind(c) :: rrcb_transfer_report
    integer(c_size_t) :: size = 32, peak_bytes = 0, bytes_sent = 0, num_messages = 0
  end type

  !> Number of points that stay with the new numbers of parts, and with the old ones.
  type, public, bind(c) :: rrcb_remap_report
    integer(c_size_t) :: size = 40
    integer(c_int) :: identity = 1
    integer(c_int64_t) :: num_points = 0, kept_before = 0, kept_after = 0
  end type

  !> Returns a view of interleaved points: coordinates(dimension, points), weights(points).
  interface rrcb_interleaved_points
    procedure :: interleaved_doubles, interleaved_reals
  end interface

  !> Returns a view of one array for each axis; all must have the same length.
  interface rrcb_column_points
    procedure :: columns_of_doubles, columns_of_reals
  end interface

  !> Returns a column with one value for each point, with the shape (components, points), or of
  !> bytes. The arrays may be longer than needed.
  interface rrcb_column
    procedure :: column_of_reals, column_of_doubles, column_of_integers, column_of_longs, &
      vectors_of_reals, vectors_of_doubles, vectors_of_integers, vectors_of_longs, column_of_bytes
  end interface

  public :: rrcb_interleaved_points, rrcb_column_points, address_of, place_of, room_for, &
    columns_in_c, indices_at, numbers_at, check_number

contains

  !> Returns the address of weights or other numbers; null if they are not present.
  function address_of(values) result(address)
    real(c_double), pointer, contiguous, intent(in), optional :: values(:)
    type(c_ptr) :: address
    address = c_null_ptr
    if (.not. present(values)) return
    if (size(values) > 0) address = c_loc(values)
  end function

  !> Returns the address for a new handle; null if there is a handle already, and the call fails on
  !> all ranks.
  function room_for(handle) result(address)
    type(c_ptr), target, intent(in) :: handle
    type(c_ptr) :: address
    address = c_null_ptr
    if (.not. c_associated(handle)) address = c_loc(handle)
  end function

  !> Returns the address of an array if it has `count` entries; otherwise null, and the call fails
  !> on all ranks.
  function place_of(parts, count) result(address)
    integer(c_int32_t), intent(in), target, contiguous :: parts(:)
    integer(c_size_t), intent(in) :: count
    type(c_ptr) :: address
    address = c_null_ptr
    if (size(parts, kind=c_size_t) >= count .and. size(parts) > 0) address = c_loc(parts)
  end function

  !> Returns columns for calls that read and write this many points. An array that is too short gets
  !> no address, and the call fails on all ranks.
  function columns_in_c(columns, num_read, num_written) result(in_c)
    type(rrcb_column), intent(in) :: columns(:)
    integer(c_size_t), intent(in) :: num_read, num_written
    type(c_column) :: in_c(size(columns))
    integer :: i
    do i = 1, size(columns)
      in_c(i)%type = columns(i)%type
      in_c(i)%components = columns(i)%components
      if (columns(i)%num_from >= num_read) in_c(i)%from = columns(i)%from
      if (columns(i)%num_to >= num_written) in_c(i)%to = columns(i)%to
    end do
  end function

  !> Copies indices of points from a list of C. In Fortran they count from 1.
  function indices_at(address, count) result(indices)
    type(c_ptr), intent(in) :: address
    integer(c_size_t), intent(in) :: count
    integer(c_size_t), allocatable :: indices(:)
    integer(c_size_t), pointer :: list(:)
    call c_f_pointer(address, list, [count])
    indices = list + 1
  end function

  !> Copies ranks, parts or shifts from a list of C.
  function numbers_at(address, count) result(numbers)
    type(c_ptr), intent(in) :: address
    integer(c_size_t), intent(in) :: count
    integer(c_int32_t), allocatable :: numbers(:)
    integer(c_int32_t), pointer :: list(:)
    call c_f_pointer(address, list, [count])
    numbers = list
  end function

  function interleaved_doubles(coordinates, weights) result(points)
    real(c_double), pointer, contiguous, intent(in) :: coordinates(:, :)
    real(c_double), pointer, contiguous, intent(in), optional :: weights(:)
    type(rrcb_points) :: points
    points = interleaved(rrcb_double, shape(coordinates, c_size_t), coordinates, weights)
  end function

  function columns_of_doubles(x, y, z, weights) result(points)
    real(c_double), pointer, contiguous, intent(in) :: x(:)
    real(c_double), pointer, contiguous, intent(in), optional :: y(:), z(:)
    real(c_double), pointer, contiguous, intent(in), optional :: weights(:)
    type(rrcb_points) :: points
    points = interleaved(rrcb_double, [1_c_size_t, size(x, kind=c_size_t)], x, weights)
    if (present(y)) call add_axis(size(y, kind=c_size_t), y, points)
    if (present(z)) call add_axis(size(z, kind=c_size_t), z, points)
  end function

  function interleaved_reals(coordinates, weights) result(points)
    real(c_float), pointer, contiguous, intent(in) :: coordinates(:, :)
    real(c_double), pointer, contiguous, intent(in), optional :: weights(:)
    type(rrcb_points) :: points
    points = interleaved(rrcb_float, shape(coordinates, c_size_t), coordinates, weights)
  end function

  function columns_of_reals(x, y, z, weights) result(points)
    real(c_float), pointer, contiguous, intent(in) :: x(:)
    real(c_float), pointer, contiguous, intent(in), optional :: y(:), z(:)
    real(c_double), pointer, contiguous, intent(in), optional :: weights(:)
    type(rrcb_points) :: points
    points = interleaved(rrcb_float, [1_c_size_t, size(x, kind=c_size_t)], x, weights)
    if (present(y)) call add_axis(size(y, kind=c_size_t), y, points)
    if (present(z)) call add_axis(size(z, kind=c_size_t), z, points)
  end function

  !> Returns a view of interleaved points with the extents (dimension, count).
  function interleaved(type, extents, first, weights) result(points)
    integer(c_int), intent(in) :: type
    integer(c_size_t), intent(in) :: extents(2)
    type(*), target, intent(in) :: first(*)
    real(c_double), pointer, contiguous, intent(in), optional :: weights(:)
    type(rrcb_points) :: points
    integer :: axis
    points%type = type
    points%dimension = int(extents(1), c_int)
    points%count = extents(2)
    points%stride = extents(1)*bytes_of(type)
    points%weights = address_of(weights)
    if (extents(1) < 1 .or. extents(1) > 3) call note_fault(wrong_shape, extents(1), points)
    if (present(weights)) then
      if (size(weights, kind=c_size_t) /= points%count) &
        call note_fault(wrong_weights, size(weights, kind=c_size_t), points)
    end if
    if (product(extents) == 0) return
    do axis = 0, min(points%dimension, 3) - 1
      points%axes(axis + 1) = transfer(transfer(c_loc(first), 0_c_intptr_t) + axis*bytes_of(type), c_null_ptr)
    end do
  end function

  !> Makes calls with these points fail because `extent` does not fit. An earlier fault is kept.
  pure subroutine note_fault(fault, extent, points)
    integer(c_int), intent(in) :: fault
    integer(c_size_t), intent(in) :: extent
    type(rrcb_points), intent(inout) :: points
    if (points%type >= wrong_weights) return
    points%type = fault
    points%stride = extent
  end subroutine

  !> Makes calls with these points fail unless the number of radii is that of the points.
  pure subroutine check_number(count, points)
    integer(c_size_t), intent(in) :: count
    type(rrcb_points), intent(inout) :: points
    if (count /= points%count) call note_fault(wrong_radii, count, points)
  end subroutine

  !> Adds an axis with as many coordinates as there are points.
  subroutine add_axis(count, first, points)
    integer(c_size_t), intent(in) :: count
    type(*), target, intent(in) :: first(*)
    type(rrcb_points), intent(inout) :: points
    points%dimension = points%dimension + 1
    if (count /= points%count) call note_fault(wrong_axis, count, points)
    if (c_associated(points%axes(1))) points%axes(points%dimension) = c_loc(first)
  end subroutine

  pure function bytes_of(type) result(bytes)
    integer(c_int), intent(in) :: type
    integer(c_size_t) :: bytes
    bytes = merge(4, 8, type == rrcb_float)
  end function

  !> Returns a column of arrays with the extents (components, points); `from` determines the
  !> components.
  function column_of(type, of_from, from, of_to, to) result(column)
    integer(c_int), intent(in) :: type
    integer(c_size_t), intent(in) :: of_from(2), of_to(2)
    type(*), target, intent(in) :: from(*), to(*)
    type(rrcb_column) :: column
    column%type = type
    column%components = of_from(1)
    column%num_from = of_from(2)
    column%num_to = merge(of_to(2), 0_c_size_t, of_to(1) == of_from(1))
    if (product(of_from) > 0) column%from = c_loc(from)
    if (product(of_to) > 0) column%to = c_loc(to)
  end function

  function column_of_reals(from, to) result(column)
    real(c_float), pointer, contiguous, intent(in) :: from(:), to(:)
    type(rrcb_column) :: column
    column = column_of(rrcb_float, [1_c_size_t, size(from, kind=c_size_t)], from, [1_c_size_t, size(to, kind=c_size_t)], to)
  end function

  function vectors_of_reals(from, to) result(column)
    real(c_float), pointer, contiguous, intent(in) :: from(:, :), to(:, :)
    type(rrcb_column) :: column
    column = column_of(rrcb_float, shape(from, c_size_t), from, shape(to, c_size_t), to)
  end function

  function column_of_doubles(from, to) result(column)
    real(c_double), pointer, contiguous, intent(in) :: from(:), to(:)
    type(rrcb_column) :: column
    column = column_of(rrcb_double, [1_c_size_t, size(from, kind=c_size_t)], from, [1_c_size_t, size(to, kind=c_size_t)], to)
  end function

  function vectors_of_doubles(from, to) result(column)
    real(c_double), pointer, contiguous, intent(in) :: from(:, :), to(:, :)
    type(rrcb_column) :: column
    column = column_of(rrcb_double, shape(from, c_size_t), from, shape(to, c_size_t), to)
  end function

  function column_of_integers(from, to) result(column)
    integer(c_int32_t), pointer, contiguous, intent(in) :: from(:), to(:)
    type(rrcb_column) :: column
    column = column_of(type_int32, [1_c_size_t, size(from, kind=c_size_t)], from, [1_c_size_t, size(to, kind=c_size_t)], to)
  end function

  function vectors_of_integers(from, to) result(column)
    integer(c_int32_t), pointer, contiguous, intent(in) :: from(:, :), to(:, :)
    type(rrcb_column) :: column
    column = column_of(type_int32, shape(from, c_size_t), from, shape(to, c_size_t), to)
  end function

  function column_of_longs(from, to) result(column)
    integer(c_int64_t), pointer, contiguous, intent(in) :: from(:), to(:)
    type(rrcb_column) :: column
    column = column_of(type_int64, [1_c_size_t, size(from, kind=c_size_t)], from, [1_c_size_t, size(to, kind=c_size_t)], to)
  end function

  function vectors_of_longs(from, to) result(column)
    integer(c_int64_t), pointer, contiguous, intent(in) :: from(:, :), to(:, :)
    type(rrcb_column) :: column
    column = column_of(type_int64, shape(from, c_size_t), from, shape(to, c_size_t), to)
  end function

  function column_of_bytes(bytes, from, to) result(column)
    integer(c_size_t), intent(in) :: bytes
    type(c_ptr), intent(in) :: from, to
    type(rrcb_column) :: column
    column = rrcb_column(type_byte, bytes, from, to)
  end function

end module rrcb_types
