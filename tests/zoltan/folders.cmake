# cmake -D SOURCES=src/zoltan -P folders.cmake
#
# Fails where a file includes one of a folder above its own.
cmake_minimum_required(VERSION 3.22)

set(below entry call dump handle real)
while(below)
  list(POP_FRONT below folder)
  file(GLOB files ${SOURCES}/${folder}/*.?pp)
  if(NOT files)
    message(FATAL_ERROR "${SOURCES}/${folder} has no files")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS ${file} includes REGEX "^#include \"zoltan/")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE ".*\"zoltan/([a-z]+)/.*" "\\1" included "${include}")
      if(NOT included IN_LIST below AND NOT included STREQUAL folder)
        message(FATAL_ERROR "${file}: ${include}")
      endif()
    endforeach()
  endforeach()
endwhile()
