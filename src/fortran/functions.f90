!> Functions that need no balancer: texts, measures, and ranks of parts.
module rrcb_functions
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use rrcb_types
  use rrcb_c_types
  use rrcb_c_functions
  implicit none
  private
  public :: rrcb_version, rrcb_build_info, rrcb_last_error, rrcb_bounding_box, rrcb_ranks_of_part, &
    rrcb_imbalance, rrcb_balanced_sizes, &
    text_of, save_by, settle, three_of

contains

  !> Returns the text of C at an address.
  function text_of(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    call c_f_pointer(address, letters, [c_strlen(address)])
    text = ''
    do i = 1, size(letters)
      text = text//letters(i)
    end do
  end function

  !> Copies the bytes that a function in C returns.
  subroutine save_by(show, handle, bytes, error)
    procedure(save_state) :: show
    type(c_ptr), intent(in) :: handle
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: error
    type(c_ptr) :: address
    integer(c_size_t) :: length
    integer(c_int) :: code
    integer(c_int8_t), pointer :: shown(:)
    code = show(handle, address, length)
    if (code == rrcb_ok) then
      call c_f_pointer(address, shown, [length])
      bytes = shown
    end if
    call settle(code, error)
  end subroutine

  pure function three_of(values) result(three)
    real(c_double), intent(in) :: values(:)
    real(c_double) :: three(3)
    three = 0
    three(:min(size(values), 3)) = values(:min(size(values), 3))
  end function

  !> Gives the caller the code of a function in C. If the argument `error` is not present, an error
  !> ends the program on this rank, and one of the ranks on which the same call fails prints the
  !> text.
  subroutine settle(code, error)
    integer(c_int), intent(in) :: code
    integer, intent(out), optional :: error
    if (present(error)) then
      error = code
    else if (code /= rrcb_ok) then
      if (c_prints_last_error() /= 0) then
        write (error_unit, '(2a)') 'rrcb: ', rrcb_last_error()
        flush (error_unit)
      end if
      call c_note_printed_error()
      stop 1, quiet=.true.
    end if
  end subroutine

  !> Returns the version of the library, as "major.minor.patch".
  function rrcb_version() result(text)
    character(:), allocatable :: text
    text = text_of(c_version())
  end function

  !> Returns the version, commit, compiler, MPI and options of the library.
  function rrcb_build_info() result(text)
    character(:), allocatable :: text
    text = text_of(c_build_info())
  end function

  !> Returns the text of the last error on this thread.
  function rrcb_last_error() result(text)
    character(:), allocatable :: text
    text = text_of(c_last_error())
  end function

  !> Finds the smallest box that holds all points.
  !> @param points of this rank
  !> @param lower  gets the lower end
  !> @param upper  gets the upper end
  subroutine rrcb_bounding_box(points, lower, upper, error)
    type(rrcb_points), intent(in) :: points
    real(c_double), intent(inout) :: lower(3), upper(3)
    integer, intent(out), optional :: error
    call settle(c_bounding_box(points, lower, upper), error)
  end subroutine

  !> Finds the ranks of a part.
  !> @param part      from 0
  !> @param num_parts 1 or more
  !> @param num_ranks 1 or more
  !> @param ranks     gets the consecutive ranks
  subroutine rrcb_ranks_of_part(part, num_parts, num_ranks, ranks, error)
    integer(c_int32_t), intent(in) :: part
    integer, intent(in) :: num_parts, num_ranks
    type(rrcb_rank_range), intent(inout) :: ranks
    integer, intent(out), optional :: error
    call settle(c_ranks_of_part(part, num_parts, num_ranks, ranks), error)
  end subroutine

  !> Returns the address of the weights of parts. If the number of sizes differs, returns null, and
  !> the call fails.
  function weights_at(part_weights, part_sizes) result(address)
    real(c_double), intent(in), target, contiguous :: part_weights(:)
    real(c_double), pointer, contiguous, intent(in), optional :: part_sizes(:)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(part_sizes)) then
      if (size(part_sizes) > 0 .and. size(part_sizes) /= size(part_weights)) return
    end if
    if (size(part_weights) > 0) address = c_loc(part_weights)
  end function

  !> Computes the weight of the heaviest part divided by the mean.
  !> @param part_weights weight of each part
  !> @param imbalance    gets the ratio
  !> @param part_sizes   relative, one for each part
  subroutine rrcb_imbalance(part_weights, imbalance, error, part_sizes)
    real(c_double), intent(in), target, contiguous :: part_weights(:)
    real(c_double), intent(inout) :: imbalance
    integer, intent(out), optional :: error
    real(c_double), pointer, contiguous, intent(in), optional :: part_sizes(:)
    call settle(c_imbalance(size(part_weights, kind=c_size_t), weights_at(part_weights, part_sizes), &
      address_of(part_sizes), imbalance), error)
  end subroutine

  !> Computes sizes of the parts that make their loads more even.
  !> @param loads        of each part in the last step, in any unit
  !> @param sizes        gets one for each part
  !> @param part_sizes   those of the last call
  subroutine rrcb_balanced_sizes(loads, sizes, error, part_sizes)
    real(c_double), intent(in), target, contiguous :: loads(:)
    real(c_double), intent(inout), contiguous :: sizes(:)
    integer, intent(out), optional :: error
    real(c_double), pointer, contiguous, intent(in), optional :: part_sizes(:)
    type(c_ptr) :: of_parts
    of_parts = weights_at(loads, part_sizes)
    if (size(sizes) < size(loads)) of_parts = c_null_ptr
    call settle(c_balanced_sizes(size(loads, kind=c_size_t), of_parts, address_of(part_sizes), sizes), error)
  end subroutine

end module rrcb_functions
