# The shim of examples/lammps before a class of LAMMPS' layout, before one of another layout, and in
# LAMMPS itself if it is installed.
foreach(name IN ITEMS lammps_shim lammps_shim_other_layout)
  add_library(${name}_original SHARED lammps_original.cpp)
  target_link_libraries(${name}_original PUBLIC MPI::MPI_CXX)
  rrcb_set_warnings(${name}_original)
  if(name MATCHES other_layout)
    target_compile_definitions(${name}_original PUBLIC OTHER_LAYOUT)
  endif()
  rrcb_add_test(NAME ${name} SOURCES lammps_test.cpp
                LIBRARIES "-Wl,--no-as-needed" rrcb_lammps ${name}_original RANKS 1 3 7
                LABELS examples)
endforeach()
foreach(ranks IN ITEMS 1 3 7)
  set_tests_properties(lammps_shim.np${ranks} PROPERTIES FAIL_REGULAR_EXPRESSION "another layout")
  set_tests_properties(lammps_shim_other_layout.np${ranks} PROPERTIES
    PASS_REGULAR_EXPRESSION "RRCB leaves the call to LAMMPS: its class RCB has another layout"
    FAIL_REGULAR_EXPRESSION "FAILED")
endforeach()

# A program that calls none of it; the sanitizers' runtime must come first in a process.
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  rrcb_add_mpi_run(NAME lammps_shim.no_calls RANKS 4 LABELS examples
                   COMMAND ${CMAKE_COMMAND} -E env LD_PRELOAD=$<TARGET_FILE:rrcb_lammps> RRCB_VERBOSE=1
                           $<TARGET_FILE:quick_start_c>)
  set_tests_properties(lammps_shim.no_calls PROPERTIES
    PASS_REGULAR_EXPRESSION "RRCB ${RRCB_VERSION}: no calls"
    FAIL_REGULAR_EXPRESSION "no calls.*no calls")
endif()

find_program(RRCB_LAMMPS lmp)
if(NOT RRCB_LAMMPS)
  rrcb_left_out("test of examples/lammps in LAMMPS" "lmp was not found")
elseif(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  foreach(ranks IN ITEMS 2 4)
    rrcb_add_mpi_run(
      NAME lammps_droplet.np${ranks} RANKS ${ranks} LABELS examples
      COMMAND -x LD_PRELOAD=$<TARGET_FILE:rrcb_lammps> -x RRCB_VERBOSE=1 -x RRCB_MIN_WIDTH=0.4
              ${RRCB_LAMMPS} -log none -var radius 4 -var steps 100 -in
              ${PROJECT_SOURCE_DIR}/tests/hosts/lammps/in.droplet)
    set_tests_properties(lammps_droplet.np${ranks} PROPERTIES
      PASS_REGULAR_EXPRESSION "RRCB answered ([1-9][0-9]*) of ([1-9][0-9]*) calls"
      FAIL_REGULAR_EXPRESSION "ERROR;RRCB leaves;sub-domain;Lost")
  endforeach()
endif()
