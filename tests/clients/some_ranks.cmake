# A program of which only some ranks have the plug-in. Not by two programs in one launch, at which
# mpiexec of Open MPI 5.0.7 falls.
add_executable(some_ranks_client some_ranks_client.c)
target_link_libraries(some_ranks_client PRIVATE Zoltan::zoltan MPI::MPI_C)

# add_some_ranks_run(<name> <ranks> <those with the plug-in> <seconds> <expected> <arguments>...)
function(add_some_ranks_run name ranks preloaded_ranks seconds expected)
  set(plug_in $<TARGET_FILE:rrcb_zoltan>)
  rrcb_add_mpi_run(
    NAME
    clients.some_ranks.${name}
    RANKS
    ${ranks}
    LABELS
    clients
    ENVIRONMENT
    RRCB_AGREE_SECONDS=${seconds}
    COMMAND
    sh
    -c
    "echo ' ${preloaded_ranks} ' | grep -vq \" \${OMPI_COMM_WORLD_RANK-$PMI_RANK} \" || export LD_PRELOAD=${plug_in} && exec \"$0\" \"$@\""
    $<TARGET_FILE:some_ranks_client>
    ${ARGN})
  # Most of its time it waits.
  set_tests_properties(clients.some_ranks.${name} PROPERTIES PASS_REGULAR_EXPRESSION "${expected}"
                                                             PROCESSORS 1)
endfunction()

function(expect_named name ranks preloaded_ranks missing)
  add_some_ranks_run(
    ${name} ${ranks} "${preloaded_ranks}" 4
    "no RRCB on ranks ${missing} of ${ranks}, which did not answer within 4 s" ${ARGN})
  set_tests_properties(clients.some_ranks.${name} PROPERTIES FAIL_REGULAR_EXPRESSION
                                                             "no RRCB on.*no RRCB on")
endfunction()
expect_named(first.np2 2 "0" "1")
expect_named(last.np8 8 "3 4 7" "0-2, 5-6")
# The plain ranks go on to make further handles.
expect_named(handles.np4 4 "0 2" "1, 3" 8)
# An error handler that returns leaves the decision to the program.
add_some_ranks_run(return.np3 3 "0 2" 4 "rank [02] has no handle" 1 return)
# A rank may come as late as it likes.
add_some_ranks_run(late.np3 3 "0 1 2" 1 "done" 2 late)
set_tests_properties(clients.some_ranks.late.np3 PROPERTIES FAIL_REGULAR_EXPRESSION "no RRCB")
