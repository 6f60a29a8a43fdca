# Files for pkg-config: rrcb.pc, and rrcb_zoltan.pc where there is the plug-in.
file(RELATIVE_PATH RRCB_PREFIX_ABOVE /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" RRCB_PREFIX_ABOVE "${RRCB_PREFIX_ABOVE}")

# Puts a flag before each word of a list.
function(rrcb_flags result flag)
  list(REMOVE_DUPLICATES ARGN)
  list(TRANSFORM ARGN PREPEND "${flag}")
  list(JOIN ARGN " " text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(private ${MPI_CXX_LIBRARIES})
foreach(library IN LISTS CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
  if(library MATCHES "^(stdc\\+\\+|c\\+\\+|m)$")
    list(APPEND private -l${library})
  endif()
endforeach()
rrcb_flags(RRCB_PC_PRIVATE "" ${private})
rrcb_flags(RRCB_PC_MPI_FLAGS -I ${MPI_CXX_INCLUDE_DIRS})
configure_file(${CMAKE_CURRENT_LIST_DIR}/rrcb.pc.in rrcb.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/rrcb.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)

if(RRCB_ZOLTAN)
  find_package(Zoltan QUIET)
  rrcb_flags(RRCB_PC_ZOLTAN_FLAGS -I ${Zoltan_INCLUDE_DIRS})
  rrcb_flags(RRCB_PC_ZOLTAN -l ${Zoltan_LIBRARIES})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/rrcb_zoltan.pc.in rrcb_zoltan.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/rrcb_zoltan.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT zoltan)
endif()
