# cmake -D NM=nm -D LIST=functions.inc -D PLUG_IN=librrcb_zoltan.so -D ARCHIVE=librrcb_zoltan_static.a
#       -D HEADER=rrcb_zoltan_rename.h -D ZOLTAN=libtrilinos_zoltan.so -P functions.cmake
#
# Fails unless the functions of Zoltan in the list are all that the plug-in shows, beside three of
# its own; that the archive has, under their new names alone; that the header renames; and that
# Zoltan has, but for those that some have not.
cmake_minimum_required(VERSION 3.22)

# Names behind the first words of the lines that the pattern finds.
function(names_in result pattern text)
  string(REGEX MATCHALL "${pattern}[A-Za-z_]+" names "${text}")
  list(TRANSFORM names REPLACE "${pattern}" "")
  list(SORT names)
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

function(symbols_of result kind)
  execute_process(COMMAND ${NM} --defined-only ${ARGN} OUTPUT_VARIABLE text
                  COMMAND_ERROR_IS_FATAL ANY)
  names_in(names " ${kind} " "${text}")
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

function(expect_same what names expected)
  if(NOT names STREQUAL expected)
    message(FATAL_ERROR "${what}:\n  ${names}\nand not as in ${LIST}:\n  ${expected}")
  endif()
endfunction()

file(READ ${LIST} text)
names_in(listed "\nRRCB_[A-Z]+\\(" "${text}")
names_in(optional "\nRRCB_OPTIONAL\\(" "${text}")
if(NOT listed)
  message(FATAL_ERROR "${LIST} lists nothing")
endif()

symbols_of(shown [A-Za-z] --dynamic ${PLUG_IN})
set(expected ${listed} RRCB_Parameter_Names RRCB_Version RRCB_Zoltan_Active)
list(SORT expected)
expect_same("The plug-in shows" "${shown}" "${expected}")

symbols_of(archived T ${ARCHIVE})
list(FILTER archived INCLUDE REGEX "^(RRCB_)?Zoltan_")
list(REMOVE_ITEM archived RRCB_Zoltan_Active RRCB_Zoltan_Renamed_Active)
set(renamed ${listed})
list(TRANSFORM renamed PREPEND RRCB_)
expect_same("The archive defines" "${archived}" "${renamed}")

file(READ ${HEADER} text)
names_in(renames "#define Zoltan_[A-Za-z_]+ RRCB_" "${text}")
expect_same("The header renames" "${renames}" "${listed}")

symbols_of(real T --dynamic ${ZOLTAN})
set(missing ${listed})
list(REMOVE_ITEM missing ${real} ${optional})
if(missing)
  message(FATAL_ERROR "${ZOLTAN} has no ${missing}")
endif()
