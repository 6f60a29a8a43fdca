# Packages whose files for CMake include a file that is absent end neither the configuring of the library nor that of
# a project that uses it: stand-ins for all that are optional.
set(half_installed ${CMAKE_CURRENT_BINARY_DIR}/half_installed)
foreach(package IN ITEMS Zoltan Teuchos KokkosCore Kokkos TpetraCore rapidcheck GTest)
  file(WRITE ${half_installed}/${package}Config.cmake
       "include(\${CMAKE_CURRENT_LIST_DIR}/absent.cmake)\nset(${package}_FOUND TRUE)\n")
  set(${package}_stand_in -D${package}_DIR=${half_installed})
endforeach()
set(trilinos ${Zoltan_stand_in} ${Teuchos_stand_in} ${KokkosCore_stand_in} ${Kokkos_stand_in} ${TpetraCore_stand_in})

# rrcb_add_half_installed_test(<name> <text of the list> <argument of cmake...>)
function(rrcb_add_half_installed_test name text)
  set(build ${half_installed}/${name})
  add_test(NAME install.half_installed.${name} COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${build} -G
                                                       ${CMAKE_GENERATOR} -DRRCB_FORTRAN=OFF ${ARGN})
  add_test(NAME install.half_installed.${name}.list
           COMMAND ${CMAKE_COMMAND} -D OUTPUT=${text} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake --
                   ${CMAKE_COMMAND} -E cat ${build}/left_out.txt)
  set_tests_properties(install.half_installed.${name} PROPERTIES FIXTURES_SETUP half_installed.${name})
  set_tests_properties(install.half_installed.${name}.list PROPERTIES FIXTURES_REQUIRED half_installed.${name})
  set_tests_properties(install.half_installed.${name} install.half_installed.${name}.list
                       PROPERTIES LABELS install TIMEOUT 120)
endfunction()
set(error "cannot be used: include could not find requested file: [^ ]*/absent.cmake")
rrcb_add_half_installed_test(
  packages
  "RRCB_ZOLTAN: Zoltan of Trilinos ${error}.*RRCB_TEUCHOS: Teuchos of Trilinos ${error}.*Kokkos: Kokkos ${error}.*properties: rapidcheck ${error}.*librapidcheck-dev.*libtrilinos-teuchos-dev.*libtrilinos-zoltan-dev"
  ${trilinos} ${rapidcheck_stand_in})
rrcb_add_half_installed_test(test_library "RRCB_TESTS: GoogleTest ${error}.*libgtest-dev" ${GTest_stand_in}
                             -DRRCB_EXAMPLES=OFF -DRRCB_ZOLTAN=OFF -DRRCB_TEUCHOS=OFF)

# The installed library: Zoltan and Teuchos are nothing to those who do not ask for them.
add_test(NAME install.half_installed.library
         COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/stacks -B ${half_installed}/library -G
                 ${CMAKE_GENERATOR} -DCMAKE_PREFIX_PATH=${prefix} ${trilinos})
add_test(
  NAME install.half_installed.component
  COMMAND
    ${CMAKE_COMMAND} -D FAILS=TRUE -D "OUTPUT=component zoltan needs.*cannot.*be used.*/absent.cmake" -P
    ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake -- ${CMAKE_COMMAND} -S
    ${CMAKE_CURRENT_SOURCE_DIR}/install/bare -B ${half_installed}/component -G ${CMAKE_GENERATOR}
    -DCMAKE_PREFIX_PATH=${prefix} -DCOMPONENTS=zoltan ${trilinos})
set_tests_properties(install.half_installed.library install.half_installed.component
                     PROPERTIES FIXTURES_REQUIRED installed LABELS install TIMEOUT 120)
