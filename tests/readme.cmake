cmake_minimum_required(VERSION 3.22)

# cmake -D ROOT=... -P readme.cmake
#
# Fails unless each block of C++ shown in the README and in the document of the loop is part of an
# example or a test, which are compiled and run; the indentation does not count. So must each line of CMake in the
# documents of how to install and to begin.
function(read_flat file result)
  file(READ ${file} text)
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  # A semicolon would split the blocks, as elements of a list.
  string(REPLACE ";" "," text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(compiled "")
foreach(program IN ITEMS examples/quick_start/main.cpp examples/loop/main.cpp
                        examples/loop/first.cpp
                        examples/neighbours/main.cpp
                        examples/tutorial/step1.cpp examples/tutorial/step2.cpp
                        examples/tutorial/step3.cpp examples/tutorial/step4.cpp
                        examples/tutorial/step5.cpp
                        examples/mpm/step/loop_mpi.cpp
                        tests/mpi/groups_test.cpp)
  read_flat(${ROOT}/${program} source)
  string(APPEND compiled "${source}")
endforeach()
foreach(document IN ITEMS README.md docs/loop.md docs/queries.md docs/tutorial.md
                         docs/languages.md)
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
      message(FATAL_ERROR "this C++ in ${document} is in no program:\n${block}")
    endif()
  endforeach()
endforeach()

# The same program in the other languages.
foreach(shown IN ITEMS c=quick_start_c/main.c fortran=quick_start_fortran/main.f90 python=python/quick_start.py)
  string(REGEX MATCH "^(.*)=(.*)$" shown "${shown}")
  set(language ${CMAKE_MATCH_1})
  read_flat(${ROOT}/examples/${CMAKE_MATCH_2} source)
  read_flat(${ROOT}/docs/languages.md text)
  string(REGEX MATCH "```${language}\n([^`]+)```" block "${text}")
  string(FIND "${source}" "${CMAKE_MATCH_1}" position)
  if(NOT block OR position EQUAL -1)
    message(FATAL_ERROR "the ${language} in docs/languages.md is not in its program:\n${block}")
  endif()
endforeach()

set(configured "")
foreach(project IN ITEMS examples/quick_start tests/install/embedded)
  file(STRINGS ${ROOT}/${project}/CMakeLists.txt lines)
  list(TRANSFORM lines STRIP)
  list(APPEND configured ${lines})
endforeach()
foreach(document IN ITEMS docs/install.md docs/first_program.md)
  read_flat(${ROOT}/${document} text)
  string(REGEX MATCHALL "```cmake\n[^`]+```" blocks "${text}")
  string(REGEX REPLACE "```cmake\n|```|\n" ";" lines "${blocks}")
  list(REMOVE_ITEM lines "" ${configured})
  if(lines OR NOT blocks)
    message(FATAL_ERROR "these lines of CMake in ${document} are in no project: ${lines}")
  endif()
endforeach()
