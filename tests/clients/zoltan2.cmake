# Zoltan2 over the plug-in, where it is installed.
include(rrcb_zoltan2)
if(NOT TARGET Zoltan2::zoltan2)
  return()
endif()

add_executable(zoltan2_client zoltan2_client.cpp)
rrcb_set_warnings(zoltan2_client)
set_target_properties(zoltan2_client PROPERTIES CXX_STANDARD 17)
target_link_libraries(zoltan2_client PRIVATE rrcb::zoltan Zoltan2::zoltan2)
add_client_run(zoltan2.rcb $<TARGET_FILE:zoltan2_client> RCB)
add_client_run(zoltan2.rrcb $<TARGET_FILE:zoltan2_client> RRCB)
