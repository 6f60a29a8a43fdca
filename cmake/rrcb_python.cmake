# rrcb_find_mpi4py(<result>)
#
# An interpreter with NumPy and an mpi4py of the MPI of this build; empty, with a note, if there is none.
function(rrcb_find_mpi4py result)
  find_package(Python3 COMPONENTS Interpreter QUIET)
  execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE launcher ERROR_QUIET)
  set(mpi "MPICH")
  if(launcher MATCHES "Open MPI|OpenRTE|PRRTE")
    set(mpi "Open MPI")
  endif()
  string(
    CONCAT check "import mpi4py; mpi4py.rc.initialize = False; import numpy; from mpi4py import MPI; "
                "print(MPI.Get_library_version())")
  foreach(python IN ITEMS ${Python3_EXECUTABLE} /usr/bin/python3)
    execute_process(COMMAND ${python} -c "${check}" OUTPUT_VARIABLE version ERROR_QUIET)
    if(version MATCHES "^${mpi}")
      set(${result} ${python} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${result} "" PARENT_SCOPE)
  rrcb_left_out("tests of the Python package" "no Python has mpi4py with ${mpi}")
endfunction()
