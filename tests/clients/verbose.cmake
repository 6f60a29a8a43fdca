# What shows that RRCB answers: a line for the first call, and one for all calls at exit.
add_executable(verbose_client verbose_client.cpp)
target_link_libraries(verbose_client PRIVATE rrcb_zoltan_test_program)
target_include_directories(verbose_client PRIVATE ../zoltan)
rrcb_set_warnings(verbose_client)

string(REPLACE "." "\\." version "RRCB ${RRCB_VERSION}")
set(time "[0-9.]+ ms\n")

# add_verbose_run(<name> <expected output> <unexpected output> <command>...)
function(add_verbose_run name expected unexpected)
  add_client_run(verbose.${name} ${ARGN})
  set_tests_properties(
    clients.verbose.${name}.np4 PROPERTIES PASS_REGULAR_EXPRESSION "${expected}"
                                           FAIL_REGULAR_EXPRESSION "${unexpected}")
endfunction()

set(on -x RRCB_VERBOSE=1)
set(twice "answers.*answers|RRCB [0-9.]+: .*RRCB [0-9.]+: ")
set(first "${version} answers LB_METHOD=RRCB: 1200 objects on 4 ranks in 4 parts, imbalance 1\\.0000 ")
set(first "${first}\\(measured\\), ${time}")
set(client $<TARGET_FILE:verbose_client>)
add_verbose_run(lists "${first}.*${version}: 4 calls, [0-9.]+ s, 75\\.00 % of the objects moved" "${twice}"
                ${on} ${client} ALL PARTS NONE IMPORT)
add_verbose_run(no_lists "${first}.*${version}: 1 call, [0-9.]+ s\n" "moved|${twice}" ${on} ${client}
                NONE)
add_verbose_run(unasked "time on rank 0" "answers|RRCB [0-9.]+: " $<TARGET_FILE:zoltan_drop_in> RRCB)
add_verbose_run(no_calls "${version}: no calls" "answers|${twice}" ${on} $<TARGET_FILE:zoltan_drop_in>
                RCB)
add_verbose_run(zero "time on rank 0" "answers|RRCB [0-9.]+: " -x RRCB_VERBOSE=0
                $<TARGET_FILE:zoltan_drop_in> RRCB)
# On one rank it holds for all of them.
add_verbose_run(
  one_rank "${first}.*${version}: 1 call, .* 75\\.00 %" "${twice}" sh -c
  "test \"\${OMPI_COMM_WORLD_RANK-$PMI_RANK}\" != 2 || export RRCB_VERBOSE=1 && exec \"$0\" \"$@\""
  ${client} ALL)
if(can_preload)
  add_verbose_run(
    preloaded "${version} answers LB_METHOD=RCB: 83333 objects on 4 ranks in 4 parts, imbalance 1\\.0"
    "${twice}" ${on} ${preloaded} -x RRCB_REPLACE=RCB $<TARGET_FILE:zoltan_plain> RCB)
  # No line where the path of the plug-in is wrong.
  add_verbose_run(not_there "time on rank 0" "RRCB" ${on} -x LD_PRELOAD=/nowhere/plug_in.so -x
                  RRCB_REPLACE=RCB $<TARGET_FILE:zoltan_plain> RCB)
endif()
