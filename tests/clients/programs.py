"""The programs that tests/clients/real_programs runs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Program:
    """What a client prints as its answer must agree to `agreement`, relatively."""

    name: str
    title: str
    # Debian packages; the version of the first is told.
    packages: tuple[str, ...]
    # Beside this file a .py, or an executable of the build.
    client: str
    arguments: tuple[str, ...]
    small_arguments: tuple[str, ...]
    # What is compared, with {objects} for their number.
    checked: str
    agreement: float = 0


def trilinos(*names: str) -> tuple[str, ...]:
    return tuple(f"libtrilinos-{name}-dev" for name in names)


SOLVED = "{objects} unknowns, solution to 1e-8"

PROGRAMS = [
    Program(
        name="pysph",
        title="PySPH, dam break in 3-D, balanced at every step",
        packages=("python3-pysph", "python3-pyzoltan"),
        client="pysph_client.py",
        arguments=("--dx=0.04", "--max-steps=50"),
        small_arguments=("--dx=0.1", "--max-steps=3"),
        checked="{objects} particles, sums of their positions and speeds to 1e-9",
        agreement=1e-9,
    ),
    Program(
        name="pyzoltan",
        title="PyZoltan, one partition of points",
        packages=("python3-pyzoltan",),
        client="pyzoltan_client.py",
        arguments=("100000",),
        small_arguments=("1000",),
        checked="{objects} points, each on one rank after moving",
    ),
    Program(
        name="petsc",
        title="PETSc with ML, Poisson's equation",
        packages=("python3-petsc4py-real", "python3-mpi4py"),
        client="petsc_client.py",
        arguments=("79",),
        small_arguments=("15",),
        checked=SOLVED,
        agreement=1e-8,
    ),
    Program(
        name="ml",
        title="ML, Poisson's equation",
        packages=trilinos("ml", "aztecoo", "epetra", "epetraext"),
        client="ml_client",
        arguments=("79",),
        small_arguments=("15",),
        checked=SOLVED,
        agreement=1e-8,
    ),
    Program(
        name="muelu",
        title="MueLu, Poisson's equation",
        packages=trilinos(
            *("muelu", "ifpack2", "thyra", "rtop", "xpetra", "tpetra"),
            *("kokkos-kernels", "epetra", "epetraext"),
        ),
        client="muelu_client",
        arguments=("79",),
        small_arguments=("15",),
        checked=SOLVED,
        agreement=1e-8,
    ),
    Program(
        name="zoltan2",
        title="Zoltan2, one partition of points",
        packages=trilinos("zoltan2", "tpetra", "xpetra", "epetra", "kokkos-kernels")
        + ("libptscotch-dev",),
        client="zoltan2_plain_client",
        arguments=("RCB", "500000"),
        small_arguments=("RCB", "1000"),
        checked="{objects} points with a part",
    ),
    Program(
        name="isorropia",
        title="Isorropia, points partitioned and moved",
        packages=trilinos("isorropia", "epetra"),
        client="isorropia_client",
        arguments=("200000",),
        small_arguments=("1000",),
        checked="{objects} points, norms of their coordinates to 1e-9",
        agreement=1e-9,
    ),
]
