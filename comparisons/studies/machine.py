"""What a run ran on, for the end of its report."""

from __future__ import annotations

import os
import platform
from datetime import datetime
from pathlib import Path

from document import Document

CORES = os.cpu_count() or 1


def busy_warning(record: dict[str, str]) -> list[str]:
    """What a reader must know before anything else; empty where the machine was not busy."""
    share = record.get("processor time used by other processes", "part")
    text = f"The machine was busy: other processes used {share} of its processor time during this"
    return [text + " run, so times are not to be relied on."] * (record.get("busy") == "yes")


def shared_cores(ranks: int) -> list[str]:
    """What wall times mean where ranks have no core each; empty where they have."""
    text = (
        f"{ranks} ranks share {CORES} {'cores' if CORES > 1 else 'core'}: wall times show neither"
        " balance nor scaling; the critical path, reckoned from the processor time of each rank"
        " outside MPI, stands for a core for every rank."
    )
    return [text] * (ranks > CORES)


def add_machine(document: Document, folder: Path, arguments: str) -> None:
    """Machine and arguments, and run.txt of the folder: versions and parameters."""
    document.heading("Machine, versions and arguments")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    facts = {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "memory": f"{memory:.1f} GiB",
        "system": platform.platform(),
        "written": datetime.now().astimezone().isoformat(timespec="seconds"),
        "arguments": arguments or "none",
    }
    document.table("Machine", [{"what": name, "value": value} for name, value in facts.items()])
    if (record := folder / "run.txt").exists():
        document.listing("run.txt", record.read_text())


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()
