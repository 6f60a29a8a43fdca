# Read by ctest. Open MPI starts ranks three times as fast without a search for networks and PCI devices,
# which ranks of one machine do not need.
set(ENV{OMPI_MCA_pml} ob1)
# Nor waits a second for ranks that it has ended.
set(ENV{OMPI_MCA_odls_base_sigkill_timeout} 0)
set(ENV{HWLOC_COMPONENTS} -pci,-linuxio)
