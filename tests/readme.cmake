# cmake -D ROOT=... -P readme.cmake
#
# Fails unless each block of C++ shown in the README and in the document of the loop is part of an
# example, which is compiled and run; the indentation does not count.
function(read_flat file result)
  file(READ ${file} text)
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  # A semicolon would split the blocks, as elements of a list.
  string(REPLACE ";" "," text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(compiled "")
foreach(example IN ITEMS quick_start loop)
  read_flat(${ROOT}/examples/${example}/main.cpp source)
  string(APPEND compiled "${source}")
endforeach()
foreach(document IN ITEMS README.md docs/loop.md)
  read_flat(${ROOT}/${document} text)
  string(REGEX MATCHALL "```cpp\n[^`]+```" blocks "${text}")
  list(LENGTH blocks num_blocks)
  if(num_blocks EQUAL 0)
    message(FATAL_ERROR "${document} shows no C++")
  endif()
  foreach(block IN LISTS blocks)
    string(REGEX REPLACE "^```cpp\n|```$" "" block "${block}")
    string(FIND "${compiled}" "${block}" position)
    if(position EQUAL -1)
      message(FATAL_ERROR "this C++ in ${document} is in no example:\n${block}")
    endif()
  endforeach()
endforeach()
