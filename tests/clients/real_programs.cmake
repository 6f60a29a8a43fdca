# Clients of what stands on Zoltan in Trilinos, for tests/clients/real_programs. Debian's package
# files name targets that do not exist, so they are linked by the names of the libraries.
add_library(zoltan_calls SHARED zoltan_calls.c)
target_link_libraries(zoltan_calls PRIVATE Zoltan::zoltan MPI::MPI_C ${CMAKE_DL_LIBS})
# Zoltan must lie in the process where the next library's functions are looked for.
target_link_options(zoltan_calls PRIVATE LINKER:--no-as-needed)
rrcb_set_warnings(zoltan_calls)
add_custom_target(real_program_clients DEPENDS zoltan_calls)

# add_trilinos_client(name HEADERS one of each Debian package... LIBRARIES names...)
function(add_trilinos_client name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(libraries)
  foreach(file IN LISTS ARG_HEADERS ARG_LIBRARIES)
    string(MAKE_C_IDENTIFIER "RRCB_TRILINOS_${file}" variable)
    if(file IN_LIST ARG_HEADERS)
      find_path(${variable} ${file} PATH_SUFFIXES trilinos)
    else()
      find_library(${variable} trilinos_${file})
      list(APPEND libraries ${${variable}})
    endif()
    mark_as_advanced(${variable})
    if(NOT ${variable})
      set(left_out_clients ${left_out_clients} ${name} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  add_executable(${name} ${name}.cpp)
  rrcb_set_warnings(${name})
  # The headers of Trilinos 13 are no C++20.
  set_target_properties(${name} PROPERTIES CXX_STANDARD 17)
  target_link_libraries(${name} PRIVATE ${libraries} Zoltan::zoltan MPI::MPI_CXX)
  add_dependencies(real_program_clients ${name})
endfunction()

set(left_out_clients)
add_trilinos_client(
  ml_client
  HEADERS ml_MultiLevelPreconditioner.h AztecOO.h Epetra_CrsMatrix.h EpetraExt_SolverMap_CrsMatrix.h
  LIBRARIES ml aztecoo epetraext epetra teuchosparameterlist teuchoscore)
add_trilinos_client(
  muelu_client
  HEADERS MueLu_CreateTpetraPreconditioner.hpp
          Ifpack2_Preconditioner.hpp
          Thyra_ProductVectorSpaceBase.hpp
          RTOpPack_Types.hpp
          Xpetra_Matrix.hpp
          Tpetra_CrsMatrix.hpp
          KokkosKernels_config.h
          EpetraExt_config.h
  LIBRARIES muelu-interface muelu xpetra-sup xpetra tpetra kokkoscore teuchoscomm
            teuchosparameterlist teuchoscore)
add_trilinos_client(
  isorropia_client
  HEADERS Isorropia_EpetraPartitioner.hpp Epetra_MultiVector.h
  LIBRARIES isorropia epetra teuchosparameterlist teuchoscore)
if(TARGET zoltan2_plain_client)
  add_dependencies(real_program_clients zoltan2_plain_client)
endif()
if(left_out_clients)
  list(JOIN left_out_clients ", " left_out_clients)
  rrcb_left_out("${left_out_clients}" "tests/clients/real_programs installs what they need")
endif()

# Those that are not installed are skipped with the reason. PySPH's first run compiles for a while.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS programs.py)
file(STRINGS programs.py programs REGEX "^ +name=\"")
list(TRANSFORM programs REPLACE ".*\"(.*)\".*" "\\1")
foreach(program IN LISTS programs)
  set(test clients.real_programs.${program}.np2)
  add_test(NAME ${test} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/real_programs --smoke --ranks=2
                                --only=${program} --build=${PROJECT_BINARY_DIR})
  rrcb_set_tests_properties(${test} PROPERTIES LABELS clients TIMEOUT 300 PROCESSORS 2
                                          SKIP_RETURN_CODE 77)
endforeach()
