"""What a run ran on, for the end of its report."""

from __future__ import annotations

import os
import platform
from datetime import datetime
from pathlib import Path

from document import Document


def read_record(folder: Path) -> dict[str, str]:
    """The lines `name: value` of run.txt."""
    path = folder / "run.txt"
    lines = path.read_text().splitlines() if path.exists() else []
    return dict(line.split(": ", 1) for line in lines if ": " in line)


def busy_warning(record: dict[str, str]) -> list[str]:
    """What a reader must know before anything else; empty where the machine was not busy."""
    if record.get("busy") != "yes":
        return []
    share = record.get("processor time used by other processes", "part")
    return [
        f"The machine was busy: other processes used {share} of its processor time during this run,"
        " so times are not to be relied on."
    ]


def shared_cores(ranks: int) -> list[str]:
    """What wall times mean where ranks have no core each; empty where they have."""
    cores = os.cpu_count() or 1
    if ranks <= cores:
        return []
    return [
        f"{ranks} ranks share {cores} {'cores' if cores > 1 else 'core'}: wall times show neither"
        " balance nor scaling; the critical path, reckoned from the processor time of each rank"
        " outside MPI, stands for a core for every rank."
    ]


def add_machine(document: Document, folder: Path, arguments: str) -> None:
    """Machine and arguments, and run.txt of the folder: versions and parameters."""
    document.heading("Machine, versions and arguments")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    facts = [
        ["processor", _processor()],
        ["cores", str(os.cpu_count())],
        ["memory", f"{memory:.1f} GiB"],
        ["system", platform.platform()],
        ["written", datetime.now().astimezone().isoformat(timespec="seconds")],
        ["arguments", arguments or "none"],
    ]
    document.table("Machine", ["what", "value"], facts)
    if (folder / "run.txt").exists():
        document.listing("run.txt", (folder / "run.txt").read_text())


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()
