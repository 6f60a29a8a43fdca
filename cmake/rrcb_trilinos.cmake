# rrcb_find_trilinos(<package>)
#
# Finds one package of Trilinos and offers it as <package>::<package in lower case>; defines nothing
# when it is not there. A Zoltan of its own configure has no files for CMake: Zoltan_INCLUDE_DIRS and
# Zoltan_LIBRARIES name it. Debian's Trilinos exports un-namespaced targets without include
# directories, so they are wrapped; installed with the library, for rrcbConfig.cmake.
function(rrcb_find_trilinos package)
  string(TOLOWER ${package} name)
  set(target ${package}::${name})
  if(NOT TARGET ${target} AND NOT ${package}_LIBRARIES)
    find_package(${package} QUIET)
  endif()
  if(TARGET ${target} OR NOT ${package}_LIBRARIES)
    return()
  endif()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${${package}_INCLUDE_DIRS})
  target_link_libraries(${target} INTERFACE MPI::MPI_CXX)
  foreach(library IN LISTS ${package}_LIBRARIES)
    rrcb_link_alone(${target} ${library})
  endforeach()
endfunction()

# Links a shared library by its file. Its target names libraries whose development files Debian's
# package of it does not depend on (Scotch), and is not ours to mend; the shared library itself
# finds them when it is loaded.
function(rrcb_link_alone target library)
  set(type none)
  if(TARGET ${library})
    get_target_property(type ${library} TYPE)
  endif()
  if(type STREQUAL "SHARED_LIBRARY")
    set(library $<TARGET_FILE:${library}>)
  endif()
  target_link_libraries(${target} INTERFACE ${library})
endfunction()
