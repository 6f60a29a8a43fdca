# Finds what the enabled parts stand on. Debian's Trilinos exports un-namespaced targets without
# include directories, so they are wrapped here as Zoltan::zoltan and Teuchos::teuchos.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)

function(rrcb_wrap_trilinos target package libraries include_dirs)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${include_dirs})
  target_link_libraries(${target} INTERFACE ${libraries} MPI::MPI_CXX)
endfunction()

if(RRCB_ZOLTAN OR RRCB_COMPARISONS)
  find_package(Zoltan REQUIRED)
  rrcb_wrap_trilinos(Zoltan::zoltan Zoltan "${Zoltan_LIBRARIES}" "${Zoltan_INCLUDE_DIRS}")
endif()

if(RRCB_COMPARISONS OR RRCB_EXAMPLES)
  find_package(Teuchos REQUIRED)
  rrcb_wrap_trilinos(Teuchos::teuchos Teuchos "${Teuchos_LIBRARIES}" "${Teuchos_INCLUDE_DIRS}")
endif()
