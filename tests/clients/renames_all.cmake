# cmake -D NM=nm -D ARCHIVE=librrcb_zoltan_static.a -D PLUG_IN=librrcb_zoltan.so -P renames_all.cmake
#
# Fails unless every function of Zoltan that the plug-in interposes is in the archive under its
# renamed name alone.
cmake_minimum_required(VERSION 3.22)

function(defined_symbols result)
  execute_process(COMMAND ${NM} --defined-only ${ARGN} OUTPUT_VARIABLE symbols
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL " T (RRCB_)?Zoltan_[A-Za-z_]+" symbols "${symbols}")
  string(REPLACE " T " "" symbols "${symbols}")
  set(${result} "${symbols}" PARENT_SCOPE)
endfunction()

defined_symbols(interposed --dynamic ${PLUG_IN})
defined_symbols(archived ${ARCHIVE})
list(FILTER interposed EXCLUDE REGEX "^RRCB_")
if(NOT interposed)
  message(FATAL_ERROR "${PLUG_IN} interposes nothing")
endif()
foreach(function IN LISTS interposed)
  if(function IN_LIST archived OR NOT RRCB_${function} IN_LIST archived)
    message(FATAL_ERROR "rrcb_zoltan_rename.h does not rename ${function}")
  endif()
endforeach()
