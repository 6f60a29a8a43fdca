!> Structures of the library in C, only for the other modules. `size` is the size of the structure,
!> beyond which the library reads and writes nothing.
module rrcb_c_types
  use, intrinsic :: iso_c_binding
  use rrcb_types, only: rrcb_transfer_report
  implicit none

  type, bind(c) :: c_cuts
    integer(c_size_t) :: size = 56
    integer(c_int) :: dimension = 0, num_parts = 1
    type(c_ptr) :: tree = c_null_ptr
    integer(c_int) :: group_size = 1, larger_below = 0, round_robin_block = 0
    type(c_ptr) :: numbers = c_null_ptr
    real(c_double) :: debt = 0
  end type

  type, bind(c) :: c_plan
    integer(c_size_t) :: size = 88
    integer(c_size_t) :: num_points = 0, num_points_after = 0, num_exports = 0
    type(c_ptr) :: export_indices = c_null_ptr, export_ranks = c_null_ptr, &
      export_parts = c_null_ptr
    integer(c_size_t) :: num_imports = 0
    type(c_ptr) :: import_ranks = c_null_ptr, import_indices = c_null_ptr, &
      import_parts = c_null_ptr
  end type

  type, bind(c) :: c_ghost_options
    integer(c_size_t) :: size = 64
    real(c_double) :: cutoff = -1                           !< not given
    type(c_ptr) :: cutoffs = c_null_ptr
    type(c_ptr) :: lower = c_null_ptr, upper = c_null_ptr, ranks_of_parts = c_null_ptr
    integer(c_size_t) :: num_parts = 0
    integer(c_int64_t) :: needs = 0
  end type

  type, bind(c) :: c_ghost_plan
    integer(c_size_t) :: size = 80
    integer(c_size_t) :: num_points = 0, num_ghosts = 0, num_send_ranks = 0
    type(c_ptr) :: send = c_null_ptr
    integer(c_size_t) :: num_sent = 0
    type(c_ptr) :: send_indices = c_null_ptr
    integer(c_size_t) :: num_receive_ranks = 0
    type(c_ptr) :: receive = c_null_ptr, shifts = c_null_ptr
  end type

  type, bind(c) :: c_neighbour_options
    integer(c_size_t) :: size = 64
    real(c_double) :: cutoff = 0, travel = 0
    type(c_ptr) :: lower = c_null_ptr, upper = c_null_ptr, ranks_of_parts = c_null_ptr
    integer(c_size_t) :: num_parts = 0
    integer(c_int64_t) :: needs = 0
  end type

  type, bind(c) :: c_array
    integer(c_size_t) :: size = 64
    integer(c_int) :: type = 0
    integer(c_size_t) :: components = 0
    type(c_ptr) :: values = c_null_ptr
    integer(c_size_t) :: count = 0, capacity = 0
    type(c_funptr) :: resize = c_null_funptr
    type(c_ptr) :: owner = c_null_ptr
  end type

  type, bind(c) :: c_shared_entries
    integer(c_size_t) :: size = 40
    integer(c_size_t) :: num_ranks = 0
    type(c_ptr) :: ranks = c_null_ptr
    integer(c_size_t) :: num_indices = 0
    type(c_ptr) :: indices = c_null_ptr
  end type

  type, bind(c) :: c_rank_count
    integer(c_int) :: rank = 0
    integer(c_size_t) :: count = 0
  end type

  type, bind(c) :: c_transfer_options
    integer(c_size_t) :: size = 24, max_bytes = 64*2**20
    type(c_ptr) :: report = c_null_ptr
  end type

contains

  !> Returns options with this many bytes, or the library's default, and the address of a report.
  function transfer_options(max_bytes, report) result(options)
    integer(c_size_t), intent(in), optional :: max_bytes
    type(rrcb_transfer_report), intent(in), target, optional :: report
    type(c_transfer_options) :: options
    if (present(max_bytes)) options%max_bytes = max_bytes
    if (present(report)) options%report = c_loc(report)
  end function

end module rrcb_c_types
