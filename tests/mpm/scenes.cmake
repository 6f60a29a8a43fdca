# Tests that read scene files, and of the program that runs them.
rrcb_add_test(NAME mpm_soil_test SOURCES materials/soil_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm)
rrcb_add_test(NAME mpm_balancers_test SOURCES parallel/balancers_test.cpp
              LIBRARIES mpm_test_support mpm_balancers mpm_scene RANKS 5 LABELS mpm)
rrcb_add_test(NAME mpm_ghost_nodes_test SOURCES parallel/ghost_nodes_test.cpp
              LIBRARIES mpm_test_support mpm_balancers mpm_scene RANKS 1 2 3 5 LABELS mpm)
rrcb_add_test(NAME mpm_anchor_test SOURCES effects/anchor_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm hard)
rrcb_add_test(NAME mpm_scene_file_test SOURCES scene/scene_file_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 3 LABELS mpm)
rrcb_add_test(NAME mpm_scene_reports_test SOURCES scene/scene_reports_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 3 LABELS mpm)
rrcb_add_test(NAME mpm_state_test SOURCES step/state_test.cpp LIBRARIES mpm_test_support mpm_scene
              RANKS 1 3 LABELS mpm)
rrcb_add_test(NAME mpm_reference_test SOURCES analytic/reference_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 2 LABELS mpm)
rrcb_add_test(NAME mpm_time_step_test SOURCES analytic/time_step_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm)
rrcb_add_test(NAME mpm_variations_test SOURCES analytic/variations_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm)
rrcb_add_test(NAME mpm_infinite_slope_test SOURCES analytic/infinite_slope_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm)
rrcb_add_test(NAME mpm_dam_break_test SOURCES analytic/dam_break_test.cpp
              LIBRARIES mpm_test_support mpm_scene RANKS 1 LABELS mpm)
rrcb_add_test(NAME mpm_work_columns_test SOURCES step/work_columns_test.cpp
              LIBRARIES mpm_test_support mpm_balancers mpm_scene RANKS 1 2 4 LABELS mpm)
foreach(test mpm_variations_test mpm_infinite_slope_test mpm_balancers_test mpm_work_columns_test mpm_scene_file_test mpm_reference_test mpm_soil_test
             mpm_dam_break_test mpm_anchor_test mpm_ghost_nodes_test
             mpm_time_step_test mpm_state_test mpm_scene_reports_test)
  target_compile_definitions(${test}
                             PRIVATE RRCB_SCENES="${PROJECT_SOURCE_DIR}/examples/mpm/scenes")
endforeach()

# The system's Python, as examples/mpm/pictures uses it, and what it has.
find_program(RRCB_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(RRCB_PYTHON python3)
foreach(module vtkmodules.vtkIOXML matplotlib)
  set(has_${module} FALSE)
  if(RRCB_PYTHON)
    execute_process(COMMAND ${RRCB_PYTHON} -c "import ${module}" RESULT_VARIABLE failed OUTPUT_QUIET
                    ERROR_QUIET)
    if(NOT failed)
      set(has_${module} TRUE)
    endif()
  endif()
endforeach()
set(with_vtk)
if(has_vtkmodules.vtkIOXML)
  set(with_vtk --with-vtk)
else()
  rrcb_left_out("tests of VTK files by VTK's readers" "no Python with VTK was found")
endif()

# mpm_add_scene(scene RANKS count BALANCER name CELL_SIZE m END_TIME s VTK_EVERY steps POINTS count)
#
# Runs a shipped scene in a small size and checks what the program writes.
function(mpm_add_scene scene)
  cmake_parse_arguments(ARG "" "RANKS;BALANCER;CELL_SIZE;END_TIME;VTK_EVERY;POINTS" "" ${ARGN})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${scene})
  rrcb_add_mpi_run(
    NAME mpm_scene_${scene} RANKS ${ARG_RANKS} LABELS mpm
    COMMAND
      $<TARGET_FILE:rrcb_mpm> --scene=${PROJECT_SOURCE_DIR}/examples/mpm/scenes/${scene}.yaml
      --balancer=${ARG_BALANCER} --cell-size=${ARG_CELL_SIZE} --end-time=${ARG_END_TIME}
      --vtk-every=${ARG_VTK_EVERY} --out=${out})
  set_tests_properties(mpm_scene_${scene} PROPERTIES FIXTURES_SETUP mpm_scene_${scene})
  if(RRCB_PYTHON)
    add_test(NAME mpm_scene_${scene}.output
             COMMAND ${RRCB_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/check_output.py ${out} ${ARG_POINTS}
                     ${with_vtk})
    rrcb_set_tests_properties(mpm_scene_${scene}.output PROPERTIES FIXTURES_REQUIRED mpm_scene_${scene}
                                                              TIMEOUT 60 LABELS mpm)
  endif()
endfunction()

# What a scene does not name leaves no kernel, no column, no double in a message.
add_test(NAME mpm_list_kernels
         COMMAND rrcb_mpm --list-kernels
                 --scene=${PROJECT_SOURCE_DIR}/examples/mpm/scenes/axial_bar.yaml)
string(CONCAT kernels "kernels: p2g, ghost_nodes, walls, move_nodes, g2p, elastic, migrate\n"
              "columns: x, y, velocity_x, velocity_y, mass, volume, id, "
              "stress_xx, stress_yy, stress_zz, stress_xy\n"
              "88 bytes per point\n88 bytes per migrated point\n5 doubles per ghost node\n")
rrcb_set_tests_properties(mpm_list_kernels PROPERTIES TIMEOUT 60 LABELS mpm PASS_REGULAR_EXPRESSION
                                                 "^${kernels}$")

add_subdirectory(absence)
# Nor a bit in the results, nor an instruction in a step, whether the program has it or not. Valgrind
# cannot run what the sanitizers instrument.
find_program(RRCB_VALGRIND valgrind)
if(NOT RRCB_VALGRIND)
  rrcb_left_out("tests of instructions in examples/mpm" "valgrind was not found")
endif()
if(RRCB_PYTHON)
  set(compare ${RRCB_PYTHON} ${PROJECT_SOURCE_DIR}/tests/mpm/absence/compare.py
              ${PROJECT_BINARY_DIR}/tests/mpm/absence ${PROJECT_SOURCE_DIR}/examples/mpm/scenes)
  add_test(NAME mpm_absence_bits COMMAND ${compare} --bits-only)
  if(RRCB_VALGRIND AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    add_test(NAME mpm_absence_counts COMMAND ${compare} axial_bar)
    add_test(NAME mpm_costs
             COMMAND ${RRCB_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/absence/costs.py
                     ${PROJECT_BINARY_DIR}/tests/mpm/absence
                     ${PROJECT_SOURCE_DIR}/examples/mpm/scenes)
    rrcb_set_tests_properties(mpm_absence_counts mpm_costs PROPERTIES TIMEOUT 180 LABELS mpm)
  endif()
  rrcb_set_tests_properties(mpm_absence_bits PROPERTIES TIMEOUT 60 LABELS mpm)
endif()

# A run that goes on from a state of another ends with its bits, rebalances included.
set(restart_scene --scene=${PROJECT_SOURCE_DIR}/examples/mpm/scenes/slope.yaml --cell-size=5
                  --end-time=0.6 --every=15 --state-every=20)
set(restart_out ${CMAKE_CURRENT_BINARY_DIR}/restart)
rrcb_add_mpi_run(NAME mpm_restart.whole RANKS 3 LABELS mpm COMMAND $<TARGET_FILE:rrcb_mpm>
                 ${restart_scene} --out=${restart_out}/whole)
rrcb_add_mpi_run(NAME mpm_restart.continued RANKS 3 LABELS mpm COMMAND $<TARGET_FILE:rrcb_mpm>
                 ${restart_scene} --restart=${restart_out}/whole/state_20.mpm
                 --out=${restart_out}/continued)
add_test(NAME mpm_restart.bits
         COMMAND ${CMAKE_COMMAND} -E compare_files ${restart_out}/whole/state_40.mpm
                 ${restart_out}/continued/state_40.mpm)
set_tests_properties(mpm_restart.whole PROPERTIES FIXTURES_SETUP mpm_restart_whole)
set_tests_properties(
  mpm_restart.continued PROPERTIES FIXTURES_REQUIRED mpm_restart_whole
                                   FIXTURES_SETUP mpm_restart_continued)
rrcb_set_tests_properties(mpm_restart.bits PROPERTIES FIXTURES_REQUIRED mpm_restart_continued TIMEOUT 60
                                                 LABELS mpm)

# What is accepted, but may not be meant, is told; what cannot be, ends with an error.
set(column ${PROJECT_SOURCE_DIR}/examples/mpm/scenes/hydrostatic_column.yaml)
rrcb_add_mpi_run(NAME mpm_learned_cost RANKS 3 LABELS mpm COMMAND $<TARGET_FILE:rrcb_mpm>
                 --scene=${column} --cost=learned --cell-size=0.1
                 --out=${CMAKE_CURRENT_BINARY_DIR}/learned_cost)
set_tests_properties(mpm_learned_cost PROPERTIES
                     PASS_REGULAR_EXPRESSION "(points are counted|learned costs are used): ")
add_test(NAME mpm_cost_without_weights
         COMMAND rrcb_mpm --scene=${column} --cost=learned --balancer=root-rcb)
set_tests_properties(mpm_cost_without_weights PROPERTIES
                     PASS_REGULAR_EXPRESSION "'root-rcb' takes no weights")
file(READ ${column} light)
string(REPLACE "density: 1800" "density: 1.8" light "${light}")
file(CONFIGURE OUTPUT light.yaml CONTENT "${light}" @ONLY)
add_test(NAME mpm_warning COMMAND rrcb_mpm --scene=${CMAKE_CURRENT_BINARY_DIR}/light.yaml
                                  --end-time=1e-6 --out=${CMAKE_CURRENT_BINARY_DIR}/warning)
rrcb_set_tests_properties(mpm_warning PROPERTIES TIMEOUT 60 LABELS mpm PASS_REGULAR_EXPRESSION
                                            "warning: .*light.yaml: materials / .*kg/m.3")

# A log that is no terminal gets a line for each tenth.
add_test(NAME mpm_log COMMAND rrcb_mpm --scene=${PROJECT_SOURCE_DIR}/examples/mpm/scenes/two_disks.yaml
                              --end-time=0.02 --out=${CMAKE_CURRENT_BINARY_DIR}/log)
rrcb_set_tests_properties(mpm_log PROPERTIES TIMEOUT 60 LABELS mpm PASS_REGULAR_EXPRESSION
                                        "1[0-9].. %[^\n]*\n *2[0-9].. %.*90.. %.*\n100.0 % of 0.02 s")

# Cells beyond the memory: all ranks end with an error, and none aborts. Sanitizers need more of it.
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  file(READ ${PROJECT_SOURCE_DIR}/examples/mpm/scenes/two_disks.yaml wide)
  string(REPLACE "cells: [20, 20]" "cells: [31000, 31000]" wide "${wide}")
  # A rank's cells are those around its points: these are far apart.
  foreach(centre "1500, 700" "700, 1500")
    string(REGEX REPLACE "[, ]" "_" name "at_${centre}")
    string(
      REPLACE "    upper_right:\n"
              "    ${name}:\n      material: rubber\n      shapes:\n        disk:\n          shape: ball\n          centre: [${centre}]\n          radius: 0.2\n    upper_right:\n"
              wide "${wide}")
  endforeach()
  file(CONFIGURE OUTPUT wide.yaml CONTENT "${wide}" @ONLY)
  rrcb_add_mpi_run(
    NAME mpm_too_many_cells RANKS 2 LABELS mpm
    COMMAND sh -c [[ulimit -v 8000000 && exec "$0" "$@"]] $<TARGET_FILE:rrcb_mpm>
            --scene=${CMAKE_CURRENT_BINARY_DIR}/wide.yaml)
  set_tests_properties(
    mpm_too_many_cells PROPERTIES PASS_REGULAR_EXPRESSION "domain: the cells need more memory"
                                  FAIL_REGULAR_EXPRESSION "MPI_ABORT")
endif()

mpm_add_scene(slope RANKS 3 BALANCER rrcb CELL_SIZE 5 END_TIME 1 VTK_EVERY 40 POINTS 1960)
mpm_add_scene(elastic_structure RANKS 2 BALANCER rrcb-exact CELL_SIZE 0.25 END_TIME 0.2 VTK_EVERY 10
              POINTS 384)
mpm_add_scene(submarine_slide RANKS 3 BALANCER rrcb CELL_SIZE 2.5 END_TIME 1 VTK_EVERY 50 POINTS 4096)
mpm_add_scene(torpedo_anchor RANKS 3 BALANCER rrcb CELL_SIZE 0.375 END_TIME 0.1 VTK_EVERY 20 POINTS 4288)
mpm_add_scene(run_out RANKS 4 BALANCER rrcb CELL_SIZE 0.25 END_TIME 0.2 VTK_EVERY 20 POINTS 1728)
mpm_add_scene(axial_bar RANKS 2 BALANCER none CELL_SIZE 1 END_TIME 0.5 VTK_EVERY 40 POINTS 100)
mpm_add_scene(granular_column RANKS 2 BALANCER rrcb-cells CELL_SIZE 0.2 END_TIME 0.3 VTK_EVERY 40
              POINTS 800)
mpm_add_scene(vertical_cut RANKS 3 BALANCER rrcb CELL_SIZE 0.5 END_TIME 0.2 VTK_EVERY 40 POINTS 864)
mpm_add_scene(two_disks RANKS 4 BALANCER rrcb CELL_SIZE 0.05 END_TIME 0.2 VTK_EVERY 40 POINTS 1624)
mpm_add_scene(hydrostatic_column RANKS 2 BALANCER root-rcb CELL_SIZE 0.0125 END_TIME 0.02 VTK_EVERY 40
              POINTS 512)
mpm_add_scene(dam_break RANKS 4 BALANCER rrcb CELL_SIZE 0.2 END_TIME 1.4 VTK_EVERY 200 POINTS 800)
mpm_add_scene(incline_block RANKS 3 BALANCER rrcb-sampled CELL_SIZE 0.25 END_TIME 0.5 VTK_EVERY 40
              POINTS 128)

# Units of axes stand in brackets, as in comparisons.
add_test(NAME mpm_labels COMMAND sh -c [[! grep -nE '"[a-z ]+, (m|s|.?Pa|.s)\b' "$0"/*.py]]
                                 ${PROJECT_SOURCE_DIR}/examples/mpm/plots)
rrcb_set_tests_properties(mpm_labels PROPERTIES TIMEOUT 60 LABELS mpm)

# The command that compares errors with work, in its coarsest cells.
if(has_matplotlib)
  add_test(NAME mpm_accuracy
           COMMAND ${RRCB_PYTHON} ${PROJECT_SOURCE_DIR}/examples/mpm/plots/accuracy.py
                   $<TARGET_FILE:rrcb_mpm> ${CMAKE_CURRENT_BINARY_DIR}/accuracy.png --quick)
  rrcb_set_tests_properties(
    mpm_accuracy
    PROPERTIES TIMEOUT 180 LABELS mpm PASS_REGULAR_EXPRESSION
               "disks [^%]*linear [^%]* [0-9.]+ %.*disks [^%]*quadratic [^%]* [0-9.]+ %")
endif()
if(has_matplotlib)
  foreach(scene two_disks dam_break)
    add_test(NAME mpm_draw_${scene}
             COMMAND ${RRCB_PYTHON} ${PROJECT_SOURCE_DIR}/examples/mpm/plots/draw.py
                     ${CMAKE_CURRENT_BINARY_DIR}/${scene} ${CMAKE_CURRENT_BINARY_DIR}/${scene}.png
                     ${PROJECT_SOURCE_DIR}/examples/mpm/scenes/${scene}.yaml)
    rrcb_set_tests_properties(mpm_draw_${scene} PROPERTIES FIXTURES_REQUIRED mpm_scene_${scene}
                                                      TIMEOUT 60 LABELS mpm)
  endforeach()
  add_test(NAME mpm_draw_run_out
           COMMAND ${RRCB_PYTHON} ${PROJECT_SOURCE_DIR}/examples/mpm/plots/parts.py
                   ${CMAKE_CURRENT_BINARY_DIR}/run_out ${CMAKE_CURRENT_BINARY_DIR}/run_out.png)
  rrcb_set_tests_properties(mpm_draw_run_out PROPERTIES FIXTURES_REQUIRED mpm_scene_run_out TIMEOUT 60
                                                    LABELS mpm)
  set(ending_of_draw png)
  set(ending_of_animate gif)
  foreach(kind draw animate)
    add_test(NAME mpm_${kind}_anchor
             COMMAND ${RRCB_PYTHON} ${PROJECT_SOURCE_DIR}/examples/mpm/plots/${kind}.py
                     ${CMAKE_CURRENT_BINARY_DIR}/torpedo_anchor
                     ${CMAKE_CURRENT_BINARY_DIR}/anchor_${kind}.${ending_of_${kind}}
                     ${PROJECT_SOURCE_DIR}/examples/mpm/scenes/torpedo_anchor.yaml)
    rrcb_set_tests_properties(mpm_${kind}_anchor PROPERTIES FIXTURES_REQUIRED mpm_scene_torpedo_anchor
                                                       TIMEOUT 60 LABELS mpm)
  endforeach()
  # Its own drawings, the probes and the animation; drawings beside theory.
  set(pictures ${PROJECT_SOURCE_DIR}/examples/mpm/pictures --program=$<TARGET_FILE:rrcb_mpm>
               --figures=${CMAKE_CURRENT_BINARY_DIR}/figures)
  add_test(NAME mpm_pictures COMMAND ${pictures} --cell-size=5 --end-time=0.4 slope)
  add_test(NAME mpm_pictures.theory COMMAND ${pictures} --end-time=0.01 hydrostatic_column)
  rrcb_set_tests_properties(mpm_pictures mpm_pictures.theory PROPERTIES TIMEOUT 120 LABELS mpm)
endif()
