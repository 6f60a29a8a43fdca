# Read by ctest. Open MPI starts ranks three times as fast without a search for networks and PCI devices,
# which ranks of one machine do not need.
set(ENV{OMPI_MCA_pml} ob1)
set(ENV{HWLOC_COMPONENTS} -pci,-linuxio)
