! fortran_client METHOD: Zoltan as its Fortran 90 interface calls it, with lists that Fortran
! allocates and frees.
module objects
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: num_objects = 400
  integer(c_int) :: rank, num_ranks
  integer :: allocations_left = huge(0)  ! before they fail

contains

  ! What Zoltan's module registers for the arrays of lists.
  subroutine allocate_integers(array, n, address)
    integer(c_int), pointer :: array(:)
    integer(c_int), intent(in) :: n
    integer(c_intptr_t), intent(out) :: address
    address = 0
    if (allocations_left == 0) return
    allocations_left = allocations_left - 1
    allocate (array(n))
    address = loc(array)
  end subroutine

  subroutine free_integers(array)
    integer(c_int), pointer :: array(:)
    deallocate (array)
  end subroutine

  integer(c_int) function count_objects()
    count_objects = num_objects
  end function

  subroutine list_objects(global_ids, local_ids)
    integer(c_int) :: global_ids(2, num_objects), local_ids(num_objects)
    integer :: i
    global_ids(1, :) = rank
    global_ids(2, :) = [(i, i=1, num_objects)]
    local_ids = global_ids(2, :)
  end subroutine

  ! Of any object of any rank, between 0 and 1.
  function position_of(its_rank, object)
    integer(c_int), intent(in) :: its_rank, object
    real(c_double) :: position_of(2)
    position_of = modulo((num_objects*its_rank + object)*[0.7548776662d0, 0.5698402910d0], 1d0)
  end function

  subroutine give_positions(n, local_ids, positions)
    integer(c_int) :: n, local_ids(n)
    real(c_double) :: positions(2, n)
    integer :: i
    do i = 1, n
      positions(:, i) = position_of(rank, local_ids(i))
    end do
  end subroutine

end module

program fortran_client
  use objects
  implicit none

  interface
    integer(c_int) function layer_partition(changes, num_import, import_gids, import_lids, &
                                            import_ranks, import_parts, num_export, export_gids, &
                                            export_lids, export_ranks, export_parts)
      use, intrinsic :: iso_c_binding
      integer(c_int) :: changes, num_import, num_export
      integer(c_int), pointer, dimension(:) :: import_gids, import_lids, import_ranks, &
                                               import_parts, export_gids, export_lids, &
                                               export_ranks, export_parts
    end function
  end interface

  type List
    integer(c_int) :: count = 0
    integer(c_int), pointer, dimension(:) :: gids => null(), lids => null(), ranks => null(), &
                                             parts => null()
  end type

  integer(c_int), external :: layer_set_param, layer_rank_of, layer_sum
  integer(c_int) :: num_faults, num_moved
  character(16) :: method
  integer :: round

  call get_command_argument(1, method)
  call layer_begin(rank, num_ranks, allocate_integers, free_integers)
  call layer_create(count_objects, list_objects, give_positions)
  num_faults = 0
  num_moved = 0
  call expect(layer_set_param("LB_METHOD"//c_null_char, trim(method)//c_null_char) == 0, "method")
  call expect(layer_set_param("KEEP_CUTS"//c_null_char, "1"//c_null_char) == 0, "KEEP_CUTS")
  do round = 1, 3
    call partition("ALL", .true., .true.)
    call partition("IMPORT", .true., .false.)
    call partition("EXPORT", .false., .true.)
    call partition("PARTS", .false., .true.)
    call partition("PARTS", .false., .true.)
    call partition("NONE", .false., .false.)
    if (round == 2) call layer_copy()
  end do
  if (method == "RRCB" .and. num_ranks > 1) call run_out_of_memory()
  num_moved = layer_sum(num_moved)
  call expect(num_ranks == 1 .or. num_moved > 0, "nothing moved")
  num_faults = layer_sum(num_faults)
  if (rank == 0) print '(a,i0,a,i0,a)', 'lists of ', num_moved, ' objects, ', num_faults, ' faults'
  call layer_end()
  if (num_faults > 0) error stop 1

contains

  subroutine expect(is_so, what)
    logical, intent(in) :: is_so
    character(*), intent(in) :: what
    if (is_so) return
    num_faults = num_faults + 1
    print '(a,i0,2a)', 'rank ', rank, ': ', what
  end subroutine

  subroutine partition(lists, has_imports, has_exports)
    character(*), intent(in) :: lists
    logical, intent(in) :: has_imports, has_exports
    type(List) :: imports, exports
    integer(c_int) :: code, changes
    logical :: is_listed
    code = layer_set_param("RETURN_LISTS"//c_null_char, lists//c_null_char)
    code = layer_partition(changes, imports%count, imports%gids, imports%lids, imports%ranks, &
                           imports%parts, exports%count, exports%gids, exports%lids, &
                           exports%ranks, exports%parts)
    call expect(code == 0, "partition")
    is_listed = changes /= 0 .or. lists == "PARTS"
    call check_shape(imports, has_imports .and. is_listed, "imports of "//lists)
    call check_shape(exports, has_exports .and. is_listed, "exports of "//lists)
    call check_imports(imports)
    call check_exports(exports)
    if (lists == "ALL") &
      call expect(layer_sum(imports%count) == layer_sum(exports%count), "imports and exports")
    num_moved = num_moved + max(exports%count, 0)
    call free(imports)
    call free(exports)
  end subroutine

  ! On one rank, at each of the arrays of its two lists; all ranks are told, and nothing stays.
  subroutine run_out_of_memory()
    type(List) :: imports, exports
    integer(c_int) :: code, changes
    integer :: arrays
    code = layer_set_param("RETURN_LISTS"//c_null_char, "ALL"//c_null_char)
    do arrays = 0, 7
      if (rank == num_ranks - 1) allocations_left = arrays
      code = layer_partition(changes, imports%count, imports%gids, imports%lids, imports%ranks, &
                             imports%parts, exports%count, exports%gids, exports%lids, &
                             exports%ranks, exports%parts)
      allocations_left = huge(0)
      call expect(code == -2, "out of memory")
      call check_shape(imports, .false., "imports without memory")
      call check_shape(exports, .false., "exports without memory")
    end do
    call partition("ALL", .true., .true.)
  end subroutine

  subroutine check_shape(checked, is_asked, what)
    type(List), intent(in) :: checked
    logical, intent(in) :: is_asked
    character(*), intent(in) :: what
    call expect(is_asked .or. checked%count <= 0, what//": not asked for")
    call expect(size_of(checked%gids) == 2*max(checked%count, 0), what//": global ids")
    call expect(size_of(checked%lids) == max(checked%count, 0), what//": local ids")
    call expect(size_of(checked%ranks) == max(checked%count, 0), what//": ranks")
    call expect(size_of(checked%parts) == max(checked%count, 0), what//": parts")
  end subroutine

  integer function size_of(array)
    integer(c_int), pointer, intent(in) :: array(:)
    size_of = 0
    if (associated(array)) size_of = size(array)
  end function

  ! Under RCB look-ups miss objects on a cut.
  subroutine expect_at(position, its_rank, what)
    real(c_double), intent(in) :: position(2)
    integer(c_int), intent(in) :: its_rank
    character(*), intent(in) :: what
    call expect(method == "RCB" .or. layer_rank_of(position) == its_rank, what)
  end subroutine

  ! They come from the rank in their id, and lie in the part of this one.
  subroutine check_imports(imports)
    type(List), intent(in) :: imports
    real(c_double) :: position(2)
    integer :: i
    if (size_of(imports%gids) < 2*imports%count) return
    do i = 1, imports%count
      call expect(imports%gids(2*i - 1) == imports%ranks(i), "import from another rank")
      call expect(imports%gids(2*i) == imports%lids(i), "import with another local id")
      position = position_of(imports%gids(2*i - 1), imports%gids(2*i))
      call expect_at(position, rank, "import of another rank's object")
    end do
  end subroutine

  subroutine check_exports(exports)
    type(List), intent(in) :: exports
    real(c_double) :: position(2)
    integer :: i
    if (size_of(exports%gids) < 2*exports%count) return
    do i = 1, exports%count
      call expect(exports%gids(2*i - 1) == rank, "export of another rank's object")
      call expect(exports%gids(2*i) == exports%lids(i), "export with another local id")
      position = position_of(rank, exports%lids(i))
      call expect_at(position, exports%ranks(i), "export to another rank")
    end do
  end subroutine

  ! As Zoltan's module does in Zoltan_LB_Free_Part.
  subroutine free(freed)
    type(List), intent(inout) :: freed
    if (associated(freed%gids)) deallocate (freed%gids)
    if (associated(freed%lids)) deallocate (freed%lids)
    if (associated(freed%ranks)) deallocate (freed%ranks)
    if (associated(freed%parts)) deallocate (freed%parts)
  end subroutine

end program
