# Sets `command` to the arguments of a script after "--".
set(command "")
foreach(index RANGE 1 ${CMAKE_ARGC})
  if(after_dashes AND index LESS CMAKE_ARGC)
    list(APPEND command ${CMAKE_ARGV${index}})
  elseif(CMAKE_ARGV${index} STREQUAL "--")
    set(after_dashes TRUE)
  endif()
endforeach()
