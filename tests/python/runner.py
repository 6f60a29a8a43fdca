"""Runs the functions test_* of a module on all ranks; ends all ranks if one fails."""
import sys
import traceback

from mpi4py import MPI

comm = MPI.COMM_WORLD


class Skip(Exception):
    """Reason why a test cannot run."""


def same_error(call, fragment):
    """Fails unless a call raises rrcb.Error with a text on every rank, the same on all."""
    import rrcb

    try:
        call()
    except rrcb.Error as error:
        texts = comm.allgather(str(error))
        assert fragment in texts[0], texts[0]
        assert len(set(texts)) == 1, texts
    else:
        raise AssertionError(f"no error: {fragment}")


def on_rank(rank, bad, good):
    return bad if comm.rank == rank else good


def run(module):
    chosen = sys.argv[1:]
    tests = [
        (name, test)
        for name, test in vars(module).items()
        if name.startswith("test_") and (not chosen or name in chosen)
    ]
    for name, test in tests:
        try:
            test()
        except Skip as reason:
            if comm.rank == 0:
                print(f"skipped {name}: {reason}")
        except BaseException:
            print(f"{name} failed on rank {comm.rank} of {comm.size}", file=sys.stderr)
            traceback.print_exc()
            sys.stderr.flush()
            comm.Abort(1)
        comm.Barrier()
    if comm.rank == 0:
        print(f"{len(tests)} tests passed on {comm.size} ranks")
