# cmake -D README=README.md -D SOURCE=main.cpp -P readme.cmake
#
# Fails unless the C++ shown in README is part of SOURCE, which is compiled and run; the
# indentation does not count.
function(read_flat file result)
  file(READ ${file} text)
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

read_flat(${README} readme)
read_flat(${SOURCE} source)
if(NOT readme MATCHES "```cpp\n([^`]+)```")
  message(FATAL_ERROR "no block of C++ in ${README}")
endif()
string(FIND "${source}" "${CMAKE_MATCH_1}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "the C++ in ${README} is not the one in ${SOURCE}")
endif()
