# The install as its users meet it: a project of their own against the installed package, and one that
# builds the library with itself where there is no Trilinos.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix)
set(consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer)

add_test(NAME install.clean COMMAND ${CMAKE_COMMAND} -E rm -rf ${prefix} ${consumer})
add_test(NAME install.install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix
                                      ${prefix})
add_test(
  NAME install.consumer
  COMMAND
    ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer}
    --build-generator ${CMAKE_GENERATOR} --build-options -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DEXPECT_ZOLTAN=${RRCB_ZOLTAN}
    -DEXPECT_TEUCHOS=${RRCB_TEUCHOS}
    "-DMPIEXEC_PREFLAGS=${RRCB_MPIEXEC_FLAGS}" --test-command ${CMAKE_CTEST_COMMAND}
    --output-on-failure --no-tests=error)
# Compiles what is installed; examples it only configures.
set(targets --build-target my_program)
if(RRCB_FORTRAN)
  list(APPEND targets --build-target rrcb_fortran)
endif()
add_test(
  NAME install.builds_without_trilinos
  COMMAND
    ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/install/embedded
    ${CMAKE_CURRENT_BINARY_DIR}/without_trilinos --build-generator ${CMAKE_GENERATOR} ${targets}
    --build-options -DRRCB_SOURCE=${PROJECT_SOURCE_DIR} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=ON
    -DCMAKE_CXX_FLAGS_DEBUG= -DCMAKE_DISABLE_FIND_PACKAGE_Zoltan=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_Teuchos=ON -DRRCB_MPM=OFF -DRRCB_EXAMPLES=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DBUILD_SHARED_LIBS=ON
    -DRRCB_FORTRAN=AUTO -DRRCB_ZOLTAN=AUTO -DRRCB_TEUCHOS=AUTO
    -DRRCB_WERROR=${RRCB_WERROR})
add_test(
  NAME install.left_out
  COMMAND
    ${CMAKE_COMMAND} -D
    "OUTPUT=RRCB_ZOLTAN: Zoltan of Trilinos was not found.*What packages add, this installs:.*tools/set_up [a-z0-9 .+-]*libtrilinos-teuchos-dev [a-z0-9 .+-]*libtrilinos-zoltan-dev" -P
    ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake -- ${CMAKE_COMMAND} -E cat
    ${CMAKE_CURRENT_BINARY_DIR}/without_trilinos/_deps/rrcb-build/left_out.txt)

include(${CMAKE_CURRENT_SOURCE_DIR}/install/half_installed.cmake)

add_test(
  NAME install.subdirectory
  COMMAND
    ${CMAKE_COMMAND} -D "OUTPUT=Generating done" -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake --
    ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/install/embedded -B
    ${CMAKE_CURRENT_BINARY_DIR}/subdirectory -G ${CMAKE_GENERATOR} -DRRCB_SUBDIRECTORY=ON
    -DRRCB_SOURCE=${PROJECT_SOURCE_DIR})
if(EXISTS ${PROJECT_SOURCE_DIR}/.git)
  add_test(NAME install.release
           COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install/release
                   ${CMAKE_CURRENT_SOURCE_DIR}/install/embedded ${CMAKE_CURRENT_BINARY_DIR}/release)
  rrcb_set_tests_properties(install.release PROPERTIES LABELS install TIMEOUT 120)
endif()

# rrcb_add_missing_test(<name> <text of the error> <argument of cmake...>)
function(rrcb_add_missing_test name text)
  add_test(
    NAME install.${name}
    COMMAND
      ${CMAKE_COMMAND} -D FAILS=TRUE -D OUTPUT=${text} -P
      ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake -- ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B
      ${CMAKE_CURRENT_BINARY_DIR}/${name} -G ${CMAKE_GENERATOR} ${ARGN})
endfunction()
rrcb_add_missing_test(asked_for_but_missing "RRCB_ZOLTAN=ON needs Zoltan of Trilinos"
                      -DRRCB_ZOLTAN=ON -DCMAKE_DISABLE_FIND_PACKAGE_Zoltan=ON)
rrcb_add_missing_test(
  names_missing_headers "RRCB needs MPI.*libopenmpi-dev.*MPI_HOME"
  -DMPI_CXX_COMPILER=${CMAKE_CURRENT_SOURCE_DIR}/install/mpi_without_headers)

# docs/build installs nothing but the packages of the site.
add_test(NAME install.set_up COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install/set_up ${PROJECT_SOURCE_DIR})
rrcb_set_tests_properties(install.set_up PROPERTIES LABELS install TIMEOUT 60)

# A Zoltan of Debian's Trilinos 16 gives the file for pkg-config that the system's gives, and programs.
if(RRCB_ZOLTAN)
  set(zoltan_targets ${CMAKE_CURRENT_BINARY_DIR}/zoltan_targets)
  set(zoltan_dir ${CMAKE_CURRENT_SOURCE_DIR}/install/zoltan_targets)
  add_test(
    NAME install.zoltan_targets
    COMMAND
      ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${zoltan_targets} -G ${CMAKE_GENERATOR}
      -DZoltan_DIR=${zoltan_dir} -DRRCB_ZOLTAN=ON -DRRCB_TESTS=OFF -DRRCB_EXAMPLES=OFF
      -DRRCB_TEUCHOS=OFF -DRRCB_FORTRAN=OFF
      -DCMAKE_INSTALL_PREFIX=${CMAKE_INSTALL_PREFIX})
  add_test(NAME install.zoltan_targets_flags
           COMMAND ${CMAKE_COMMAND} -E compare_files ${zoltan_targets}/rrcb_zoltan.pc
                   ${PROJECT_BINARY_DIR}/rrcb_zoltan.pc)
  add_test(
    NAME install.zoltan_targets_consumer
    COMMAND
      ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer
      ${zoltan_targets}/consumer --build-generator ${CMAKE_GENERATOR} --build-target zoltan_program
      --build-options -DCMAKE_PREFIX_PATH=${prefix} -DZoltan_DIR=${zoltan_dir}
      "-DMPIEXEC_PREFLAGS=${RRCB_MPIEXEC_FLAGS}" --test-command ${CMAKE_CTEST_COMMAND}
      -R zoltan_program --output-on-failure --no-tests=error)
  set_tests_properties(install.zoltan_targets PROPERTIES FIXTURES_SETUP zoltan_targets)
  set_tests_properties(install.zoltan_targets_flags PROPERTIES FIXTURES_REQUIRED zoltan_targets)
  set_tests_properties(install.zoltan_targets_consumer PROPERTIES FIXTURES_REQUIRED installed)
  rrcb_set_tests_properties(install.zoltan_targets install.zoltan_targets_flags install.zoltan_targets_consumer
                       PROPERTIES LABELS install TIMEOUT 300)
endif()

# A cache from a time when there was no compiler of Fortran.
if(RRCB_FORTRAN)
  add_test(
    NAME install.fortran_is_looked_for_again
    COMMAND
      ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${CMAKE_CURRENT_BINARY_DIR}/fortran_again -G
      ${CMAKE_GENERATOR} -DCMAKE_Fortran_COMPILER=CMAKE_Fortran_COMPILER-NOTFOUND -DRRCB_FORTRAN=ON
      -DRRCB_TESTS=OFF -DRRCB_EXAMPLES=OFF)
  rrcb_set_tests_properties(install.fortran_is_looked_for_again PROPERTIES LABELS install TIMEOUT 120)
endif()
# A package without archive and plug-in.
set(bare_prefix ${CMAKE_CURRENT_BINARY_DIR}/bare_prefix)
foreach(component IN ITEMS runtime development)
  add_test(NAME install.${component} COMMAND ${CMAKE_COMMAND} --install
                                             ${CMAKE_CURRENT_BINARY_DIR}/without_trilinos/_deps/rrcb-build
                                             --prefix ${bare_prefix} --component ${component})
  rrcb_set_tests_properties(
    install.${component} PROPERTIES FIXTURES_REQUIRED without_trilinos FIXTURES_SETUP bare LABELS install
                                    TIMEOUT 60)
endforeach()
# rrcb_add_bare_test(<name> <text> [component...])
function(rrcb_add_bare_test name text)
  add_test(NAME install.${name}
           COMMAND ${CMAKE_COMMAND} -D FAILS=TRUE -D OUTPUT=${text} -P
                   ${CMAKE_CURRENT_SOURCE_DIR}/cmake/expect.cmake -- ${CMAKE_COMMAND} -S
                   ${CMAKE_CURRENT_SOURCE_DIR}/install/bare -B ${CMAKE_CURRENT_BINARY_DIR}/${name} -G
                   ${CMAKE_GENERATOR} -DCMAKE_PREFIX_PATH=${bare_prefix} -DCOMPONENTS=${ARGN})
  rrcb_set_tests_properties(install.${name} PROPERTIES FIXTURES_REQUIRED bare LABELS install TIMEOUT 120)
endfunction()
rrcb_add_bare_test(sets_its_own_policies "rrcb is found")
rrcb_add_bare_test(names_missing_components "component fortran needs an rrcb built with" fortran)
rrcb_add_bare_test(names_unknown_components "there is no component openmp.*zoltan, teuchos, kokkos and fortran"
                   openmp)

find_program(RRCB_PKG_CONFIG pkg-config)
if(RRCB_PKG_CONFIG)
  add_test(NAME install.pkg_config
           COMMAND
             ${CMAKE_COMMAND} -E env FC=${CMAKE_Fortran_COMPILER}
             ${CMAKE_CURRENT_SOURCE_DIR}/install/pkg_config ${prefix} ${PROJECT_SOURCE_DIR}
             ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 3 ${RRCB_MPIEXEC_FLAGS})
  rrcb_set_tests_properties(install.pkg_config PROPERTIES FIXTURES_REQUIRED installed LABELS install
                                                     TIMEOUT 120)
else()
  rrcb_left_out("test of the files for pkg-config" "pkg-config was not found")
endif()
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/rrcb/*.h
       ${PROJECT_SOURCE_DIR}/include/rrcb/c/*.h
       ${PROJECT_SOURCE_DIR}/src/c/for_fortran.h
       ${PROJECT_SOURCE_DIR}/src/c/for_experimental.h
       ${PROJECT_SOURCE_DIR}/include/rrcb/*.hpp
       ${PROJECT_SOURCE_DIR}/include/rrcb/detail/*.hpp
       ${PROJECT_SOURCE_DIR}/include/rrcb/experimental/*.h
       ${PROJECT_SOURCE_DIR}/include/rrcb/experimental/*.hpp)
  file(GLOB listed ${PROJECT_SOURCE_DIR}/packaging/debian/librrcb[0-9]*.symbols)
  add_test(NAME install.symbols
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/symbols.py
                   $<TARGET_FILE:rrcb_shared> ${CMAKE_CURRENT_SOURCE_DIR}/abi/symbols.txt
                   ${listed} -- ${headers})
  add_test(NAME install.packages COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/packages.py
                                         ${PROJECT_SOURCE_DIR})
  add_test(NAME install.names
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/names.py
                   ${PROJECT_SOURCE_DIR})
  add_test(NAME install.public_names
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/public_names.py
                   ${PROJECT_SOURCE_DIR})
  add_test(NAME install.versions
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/versions.py
                   ${RRCB_VERSION} ${PROJECT_SOURCE_DIR})
  add_test(NAME install.debian COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/debian.py
                                       ${prefix} ${PROJECT_SOURCE_DIR})
  set_tests_properties(install.debian PROPERTIES FIXTURES_REQUIRED installed)
  rrcb_set_tests_properties(install.symbols install.packages install.names install.public_names install.versions
                       install.debian
                       PROPERTIES LABELS install TIMEOUT 60)
  if(RRCB_ZOLTAN AND RRCB_PKG_CONFIG AND RRCB_FORTRAN AND MPI_Fortran_HAVE_F08_MODULE AND RRCB_PYTHON)
    add_test(NAME first_steps COMMAND ${CMAKE_COMMAND} -E env CMAKE_GENERATOR=${CMAKE_GENERATOR}
                                      RRCB_PYTHON=${RRCB_PYTHON}
                                      ${CMAKE_CURRENT_SOURCE_DIR}/first_steps/run ${prefix})
    rrcb_set_tests_properties(first_steps PROPERTIES FIXTURES_REQUIRED installed LABELS install TIMEOUT 600)
  else()
    rrcb_left_out("tests of the documents' commands"
                  "the plug-in, pkg-config, mpi_f08 or mpi4py is not there")
  endif()
endif()

# The folders of examples as projects of their own, those that this build has.
if(RRCB_EXAMPLES AND Python3_FOUND)
  get_property(folders DIRECTORY ${PROJECT_SOURCE_DIR}/examples PROPERTY SUBDIRECTORIES)
  list(TRANSFORM folders REPLACE ".*/" "")
  add_test(NAME install.examples
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/install/examples.py
                   ${PROJECT_SOURCE_DIR} ${prefix} ${CMAKE_CURRENT_BINARY_DIR}/own_examples
                   ${CMAKE_GENERATOR} ${folders})
  rrcb_set_tests_properties(install.examples PROPERTIES FIXTURES_REQUIRED installed LABELS install TIMEOUT 300)
endif()

set_tests_properties(install.clean PROPERTIES FIXTURES_SETUP clean_prefix)
set_tests_properties(install.install PROPERTIES FIXTURES_REQUIRED clean_prefix FIXTURES_SETUP
                                                installed)
set_tests_properties(install.consumer PROPERTIES FIXTURES_REQUIRED installed)
set_tests_properties(install.builds_without_trilinos PROPERTIES FIXTURES_SETUP without_trilinos)
rrcb_set_tests_properties(install.left_out PROPERTIES FIXTURES_REQUIRED without_trilinos LABELS install
                                                 TIMEOUT 60)
rrcb_set_tests_properties(
  install.clean install.install install.consumer install.builds_without_trilinos install.subdirectory
  install.asked_for_but_missing install.names_missing_headers PROPERTIES LABELS install TIMEOUT 300)
set_tests_properties(install.consumer install.builds_without_trilinos PROPERTIES PROCESSORS 2)
