# rrcb_link_without_cxx(<target of MPI> [C++ library...])
#
# Makes rrcb::shared and rrcb::static usable where no compiler of C++ is enabled: both bring MPI of
# another language, and the archive names the libraries of C++. Installed, for rrcbConfig.cmake.
function(rrcb_link_without_cxx mpi)
  foreach(target IN ITEMS rrcb::shared rrcb::static)
    if(TARGET ${target})
      set_target_properties(${target} PROPERTIES INTERFACE_COMPILE_FEATURES "" INTERFACE_LINK_LIBRARIES ${mpi})
    endif()
  endforeach()
  if(TARGET rrcb::static)
    set_property(TARGET rrcb::static APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${ARGN})
    get_target_property(configurations rrcb::static IMPORTED_CONFIGURATIONS)
    foreach(configuration IN LISTS configurations)
      set_property(TARGET rrcb::static PROPERTY IMPORTED_LINK_INTERFACE_LANGUAGES_${configuration})
    endforeach()
  endif()
endfunction()
