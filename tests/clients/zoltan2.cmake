# Zoltan2 over the plug-in, where it is installed.
find_package(Zoltan2 MODULE QUIET)
if(NOT Zoltan2_FOUND)
  return()
endif()

add_library(zoltan2_client_object OBJECT zoltan2_client.cpp)
rrcb_set_warnings(zoltan2_client_object)
set_target_properties(zoltan2_client_object PROPERTIES CXX_STANDARD 17)
target_link_libraries(zoltan2_client_object PRIVATE Zoltan2::zoltan2)

add_executable(zoltan2_client)
target_link_libraries(zoltan2_client PRIVATE zoltan2_client_object rrcb::zoltan Zoltan2::zoltan2)
# Without the plug-in, for tests/clients/real_programs.
add_executable(zoltan2_plain_client)
target_link_libraries(zoltan2_plain_client PRIVATE zoltan2_client_object Zoltan2::zoltan2)

add_client_run(zoltan2.rcb $<TARGET_FILE:zoltan2_client> RCB)
add_client_run(zoltan2.rrcb $<TARGET_FILE:zoltan2_client> RRCB)
