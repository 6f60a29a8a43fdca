# Installed with the library, for rrcbConfig.cmake.

# rrcb_find_package(<package>)
#
# find_package() for an optional package, whose files for CMake may include files that are absent: such an error ends
# the configuring. A project of its own looks first; if it fails, the package is not found.
macro(rrcb_find_package package)
  rrcb_probe(${package})
  set(${package}_FOUND FALSE)
  if(NOT rrcb_failure)
    find_package(${package} QUIET)
  endif()
  if(${package}_FOUND)
    set_property(GLOBAL APPEND PROPERTY RRCB_FOUND_PACKAGES ${package})
  endif()
endmacro()

# rrcb_absence(<result> <name> <package...>)
#
# Returns the reason why none of the packages can be used, with the first line of an error of their files.
function(rrcb_absence result name)
  set(${result} "${name} was not found" PARENT_SCOPE)
  foreach(package IN LISTS ARGN)
    get_property(failure GLOBAL PROPERTY RRCB_FAILURE_${package})
    if(failure)
      set(${result} "${name} cannot be used: ${failure}" PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# rrcb_probe(<package>)
#
# Looks for a package in a project of its own, after those that were found before. Sets `rrcb_failure`, and the global
# properties RRCB_FAILURE_<package>, the first line of the error if there is one, and RRCB_FOLDER_<package>.
function(rrcb_probe package)
  set(probe ${CMAKE_BINARY_DIR}/CMakeFiles/rrcb_probe/${package})
  rrcb_settings_of_searches(settings)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  list(FILTER languages INCLUDE REGEX "^(C|CXX)$")
  list(JOIN languages " " languages)
  get_property(packages GLOBAL PROPERTY RRCB_FOUND_PACKAGES)
  list(REMOVE_DUPLICATES packages)
  list(JOIN packages " " packages)
  file(REMOVE_RECURSE ${probe})
  file(
    WRITE ${probe}/CMakeLists.txt
    "cmake_minimum_required(VERSION 3.22)\nproject(probe LANGUAGES ${languages})\n${settings}"
    "function(look_for package)\n  find_package(\${package} QUIET)\nendfunction()\n"
    "foreach(package IN ITEMS ${packages} ${package})\n  look_for(\${package})\nendforeach()\n")
  # What is known of the compilers is not found out again.
  file(COPY ${CMAKE_PLATFORM_INFO_DIR} DESTINATION ${probe}/build/CMakeFiles)
  execute_process(
    COMMAND
      ${CMAKE_COMMAND} -S ${probe} -B ${probe}/build -G ${CMAKE_GENERATOR}
      -DCMAKE_PLATFORM_INFO_INITIALIZED=1 -DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}
      -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TOOLCHAIN_FILE}
    RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE message)
  set(failure)
  if(result)
    rrcb_first_line_of_error(failure "${message}${result}")
  endif()
  file(STRINGS ${probe}/build/CMakeCache.txt folder REGEX "^${package}_DIR:")
  string(REGEX REPLACE "^[^=]*=" "" folder "${folder}")
  set_property(GLOBAL PROPERTY RRCB_FAILURE_${package} "${failure}")
  set_property(GLOBAL PROPERTY RRCB_FOLDER_${package} "${folder}")
  set(rrcb_failure "${failure}" PARENT_SCOPE)
endfunction()

# Returns lines of CMake that set what steers find_package(), in the cache or not.
function(rrcb_settings_of_searches result)
  get_cmake_property(names VARIABLES)
  set(folders ${names})
  list(FILTER folders INCLUDE REGEX "_(DIR|ROOT)$")
  list(FILTER folders EXCLUDE REGEX "^CMAKE_|_(SOURCE|BINARY)_DIR$")
  list(FILTER names INCLUDE REGEX
       "^(CMAKE_(FIND|PREFIX|MODULE_PATH|IGNORE|(SYSTEM_)?(LIBRARY|INCLUDE|PROGRAM)_PATH|DISABLE|SYSROOT)|MPI_HOME$|MPI_[A-Za-z]+_COMPILER$)")
  set(settings "")
  foreach(name IN LISTS names folders)
    string(APPEND settings "set(${name} [==[${${name}}]==])\n")
  endforeach()
  set(${result} "${settings}" PARENT_SCOPE)
endfunction()

# Returns the first line of an error of CMake, with the name in the next line if it ends with a colon.
function(rrcb_first_line_of_error result message)
  string(FIND "${message}" "CMake Error" start)
  if(start GREATER -1)
    string(SUBSTRING "${message}" ${start} -1 message)
    string(REGEX MATCH "\n.*" message "${message}")
  endif()
  string(REGEX MATCH "[^ \n][^\n]*" line "${message}")
  if(line MATCHES ":$")
    string(REGEX MATCH "[^ \n][^\n]*:\n+[^\n]+" line "${message}")
  endif()
  string(REGEX REPLACE "[ \n;]+" " " line "${line}")
  set(${result} "${line}" PARENT_SCOPE)
endfunction()
