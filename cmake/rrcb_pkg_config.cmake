# Files for pkg-config: rrcb.pc, and rrcb_zoltan.pc, rrcb_teuchos.pc and rrcb_fortran.pc if the plug-in, the
# parameter lists and the module are built.
file(RELATIVE_PATH RRCB_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR} ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH RRCB_PC_INCLUDE ${CMAKE_INSTALL_FULL_LIBDIR} ${CMAKE_INSTALL_FULL_INCLUDEDIR})

# Puts a flag before each word of a list, which may be empty; no -l before the path of a library or a flag.
function(rrcb_flags result flag)
  set(text "")
  if(ARGN)
    list(REMOVE_DUPLICATES ARGN)
    list(TRANSFORM ARGN PREPEND "${flag}")
    list(TRANSFORM ARGN REPLACE "^-l([-/])" "\\1")
    list(JOIN ARGN " " text)
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Configures and installs a file for pkg-config with a component.
function(rrcb_install_pc name component)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT ${component})
endfunction()

# A program finds the libraries where they are installed, except in a system's own folders, which the
# loader knows.
set(RRCB_PC_RUN_PATH "")
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(RRCB_PC_RUN_PATH "-Wl,-rpath,\${libdir}")
endif()

rrcb_flags(RRCB_PC_PRIVATE -l ${MPI_CXX_LIBRARIES} ${RRCB_CXX_LIBRARIES})
rrcb_flags(RRCB_PC_MPI_FLAGS -I ${MPI_CXX_INCLUDE_DIRS})
rrcb_install_pc(rrcb development)

# Names libraries in the folders that the linker searches by itself without folder and version.
function(rrcb_short_names result)
  set(names)
  foreach(file IN LISTS ARGN)
    get_filename_component(folder ${file} DIRECTORY)
    if(folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
      string(REGEX REPLACE "^.*/lib([^/]+)[.](so|a)([.0-9]*)$" "\\1" file ${file})
    endif()
    list(APPEND names ${file})
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# Sets RRCB_PC_<name> and RRCB_PC_<name>_FLAGS to the flags that link a target of Trilinos, and find its headers.
function(rrcb_flags_of name target)
  rrcb_header_folders(folders ${target})
  list(REMOVE_ITEM folders "" ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})
  rrcb_link_files(files ${target})
  rrcb_short_names(files ${files})
  rrcb_flags(flags -I ${folders})
  rrcb_flags(libraries -l ${files})
  set(RRCB_PC_${name}_FLAGS "${flags}" PARENT_SCOPE)
  set(RRCB_PC_${name} "${libraries}" PARENT_SCOPE)
endfunction()

if(RRCB_ZOLTAN)
  rrcb_flags_of(ZOLTAN Zoltan::zoltan)
  rrcb_install_pc(rrcb_zoltan zoltan)
endif()
if(RRCB_TEUCHOS)
  rrcb_flags_of(TEUCHOS Teuchos::teuchos)
  # As an archive it takes the table of options from the archive of the library: the shared one hides it.
  set(RRCB_PC_TEUCHOS_RRCB -l:librrcb.a)
  if(BUILD_SHARED_LIBS)
    set(RRCB_PC_TEUCHOS_RRCB -lrrcb)
  endif()
  rrcb_install_pc(rrcb_teuchos teuchos)
endif()

# A program in Fortran calls MPI by MPI's own module; where there is none, its compiler has to know.
if(RRCB_FORTRAN)
  rrcb_flags(RRCB_PC_FORTRAN_FLAGS -I ${MPI_Fortran_INCLUDE_DIRS})
  rrcb_flags(RRCB_PC_FORTRAN_PRIVATE "" ${MPI_Fortran_LIBRARIES})
  rrcb_install_pc(rrcb_fortran development)
endif()
