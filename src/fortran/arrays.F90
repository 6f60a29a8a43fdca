!> Arrays that calls lengthen or shorten.
module rrcb_arrays
  use, intrinsic :: iso_c_binding
  use rrcb_types
  use rrcb_c_types
  implicit none
  private
  public :: arrays_in_c, points_in

  !> Contains an allocatable array during calls that change its number of points, which is the last
  !> extent: `call array%take(x)` moves x here without a copy, and `call array%give(x)` moves it
  !> back. x is real(4), real(8), integer(4) or integer(8), with the shape (points) or (components,
  !> points).
  type, public :: rrcb_array
    private
    integer(c_int) :: type = 0
    integer(c_size_t) :: components = 0, count = 0
    real(c_float), allocatable :: reals(:), real_vectors(:, :)
    real(c_double), allocatable :: doubles(:), double_vectors(:, :)
    integer(c_int32_t), allocatable :: integers(:), integer_vectors(:, :)
    integer(c_int64_t), allocatable :: longs(:), long_vectors(:, :)
  contains
    generic :: take => take_reals, take_real_vectors, take_doubles, take_double_vectors, &
      take_integers, take_integer_vectors, take_longs, take_long_vectors
    generic :: give => give_reals, give_real_vectors, give_doubles, give_double_vectors, &
      give_integers, give_integer_vectors, give_longs, give_long_vectors
    procedure, private :: take_reals, take_real_vectors, take_doubles, take_double_vectors, &
      take_integers, take_integer_vectors, take_longs, take_long_vectors
    procedure, private :: give_reals, give_real_vectors, give_doubles, give_double_vectors, &
      give_integers, give_integer_vectors, give_longs, give_long_vectors
  end type

contains

  !> Returns arrays in the form in which the library changes them.
  function arrays_in_c(arrays) result(in_c)
    type(rrcb_array), intent(in), target :: arrays(:)
    type(c_array) :: in_c(size(arrays))
    integer :: k
    do k = 1, size(arrays)
      in_c(k)%type = arrays(k)%type
      in_c(k)%components = arrays(k)%components
      in_c(k)%count = arrays(k)%count
      in_c(k)%owner = c_loc(arrays(k))
      in_c(k)%values = resize(in_c(k)%owner, arrays(k)%count)
      in_c(k)%resize = c_funloc(resize)
    end do
  end function

  !> Returns a view of positions: the first array, or the first `axes` arrays.
  function points_in(arrays, axes) result(points)
    type(c_array), intent(in) :: arrays(:)
    integer, intent(in), optional :: axes
    type(rrcb_points) :: points
    integer(c_size_t) :: bytes
    integer :: axis
    if (size(arrays) == 0) return
    bytes = merge(4, 8, arrays(1)%type == rrcb_float)
    points%type = arrays(1)%type
    points%dimension = int(arrays(1)%components, c_int)
    if (present(axes)) points%dimension = int(min(axes, size(arrays)), c_int)
    points%count = arrays(1)%count
    points%stride = bytes*arrays(1)%components
    do axis = 1, min(points%dimension, 3)
      if (present(axes)) then
        points%axes(axis) = arrays(axis)%values
      else if (c_associated(arrays(1)%values)) then
        points%axes(axis) = transfer(transfer(arrays(1)%values, 0_c_intptr_t) + (axis - 1)*bytes, c_null_ptr)
      end if
    end do
  end function

  !> Changes the number of points of an array. Returns its address, or null if there is no memory.
  function resize(owner, count) result(address) bind(c, name="")
    type(c_ptr), value :: owner
    integer(c_size_t), value :: count
    type(c_ptr) :: address
    type(rrcb_array), pointer :: array
    call c_f_pointer(owner, array)
    address = c_null_ptr
    if (allocated(array%reals)) address = resize_reals(array%reals, count)
    if (allocated(array%real_vectors)) address = resize_real_vectors(array%real_vectors, count)
    if (allocated(array%doubles)) address = resize_doubles(array%doubles, count)
    if (allocated(array%double_vectors)) address = resize_double_vectors(array%double_vectors, count)
    if (allocated(array%integers)) address = resize_integers(array%integers, count)
    if (allocated(array%integer_vectors)) address = resize_integer_vectors(array%integer_vectors, count)
    if (allocated(array%longs)) address = resize_longs(array%longs, count)
    if (allocated(array%long_vectors)) address = resize_long_vectors(array%long_vectors, count)
    if (count == 0 .or. c_associated(address)) array%count = count
  end function

#define ARRAY_RANK 1
#define ARRAY_ALL :
#define ARRAY_NONE 0
#define ARRAY_COMPONENTS 1
#define ARRAY_ROW
#define ARRAY_ROWS
#define ARRAY_KIND real(c_float)
#define ARRAY_TYPE rrcb_float
#define ARRAY_FIELD reals
#define ARRAY_TAKE take_reals
#define ARRAY_GIVE give_reals
#define ARRAY_RESIZE resize_reals
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND real(c_double)
#define ARRAY_TYPE rrcb_double
#define ARRAY_FIELD doubles
#define ARRAY_TAKE take_doubles
#define ARRAY_GIVE give_doubles
#define ARRAY_RESIZE resize_doubles
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND integer(c_int32_t)
#define ARRAY_TYPE type_int32
#define ARRAY_FIELD integers
#define ARRAY_TAKE take_integers
#define ARRAY_GIVE give_integers
#define ARRAY_RESIZE resize_integers
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND integer(c_int64_t)
#define ARRAY_TYPE type_int64
#define ARRAY_FIELD longs
#define ARRAY_TAKE take_longs
#define ARRAY_GIVE give_longs
#define ARRAY_RESIZE resize_longs
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#undef ARRAY_RANK
#undef ARRAY_ALL
#undef ARRAY_NONE
#undef ARRAY_COMPONENTS
#undef ARRAY_ROW
#undef ARRAY_ROWS

#define ARRAY_RANK 2
#define ARRAY_ALL :, :
#define ARRAY_NONE 0, 0
#define ARRAY_COMPONENTS size(values, 1, kind=c_size_t)
#define ARRAY_ROW size(values, 1),
#define ARRAY_ROWS :,
#define ARRAY_KIND real(c_float)
#define ARRAY_TYPE rrcb_float
#define ARRAY_FIELD real_vectors
#define ARRAY_TAKE take_real_vectors
#define ARRAY_GIVE give_real_vectors
#define ARRAY_RESIZE resize_real_vectors
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND real(c_double)
#define ARRAY_TYPE rrcb_double
#define ARRAY_FIELD double_vectors
#define ARRAY_TAKE take_double_vectors
#define ARRAY_GIVE give_double_vectors
#define ARRAY_RESIZE resize_double_vectors
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND integer(c_int32_t)
#define ARRAY_TYPE type_int32
#define ARRAY_FIELD integer_vectors
#define ARRAY_TAKE take_integer_vectors
#define ARRAY_GIVE give_integer_vectors
#define ARRAY_RESIZE resize_integer_vectors
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE
#define ARRAY_KIND integer(c_int64_t)
#define ARRAY_TYPE type_int64
#define ARRAY_FIELD long_vectors
#define ARRAY_TAKE take_long_vectors
#define ARRAY_GIVE give_long_vectors
#define ARRAY_RESIZE resize_long_vectors
#include "array_of.inc"
#undef ARRAY_KIND
#undef ARRAY_TYPE

end module rrcb_arrays
