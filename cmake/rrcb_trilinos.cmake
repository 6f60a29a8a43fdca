# rrcb_find_trilinos(<package>)
#
# Finds one package of Trilinos and offers it as <package>::<package in lower case>; defines nothing
# when it is not there. Debian's Trilinos exports un-namespaced targets without include
# directories, so they are wrapped; installed with the library, for rrcbConfig.cmake.
function(rrcb_find_trilinos package)
  string(TOLOWER ${package} name)
  set(target ${package}::${name})
  if(NOT TARGET ${target})
    find_package(${package} QUIET)
  endif()
  if(TARGET ${target} OR NOT ${package}_FOUND)
    return()
  endif()
  foreach(library IN LISTS ${package}_LIBRARIES)
    rrcb_drop_missing_links(${library})
  endforeach()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${${package}_INCLUDE_DIRS})
  target_link_libraries(${target} INTERFACE ${${package}_LIBRARIES} MPI::MPI_CXX)
endfunction()

# Debian's Trilinos names libraries whose development files it does not depend on (Scotch). The
# shared library itself finds them when it is loaded; a program need not link them.
function(rrcb_drop_missing_links library)
  get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
  set(present)
  foreach(link IN LISTS links)
    if(NOT IS_ABSOLUTE "${link}" OR EXISTS "${link}")
      list(APPEND present "${link}")
    endif()
  endforeach()
  set_target_properties(${library} PROPERTIES INTERFACE_LINK_LIBRARIES "${present}")
endfunction()
