"""A report that consists of text, tables and pictures, written as report.md."""

from __future__ import annotations

import os
import platform
from pathlib import Path

import pandas as pd

CORES = os.cpu_count() or 1


class Report:
    def __init__(self, title: str, folder: Path) -> None:
        self.folder = folder
        self.blocks = [f"# {title}"]

    def text(self, text: str) -> None:
        """Adds a paragraph unless the text is empty."""
        self.blocks += [text] * bool(text)

    def say(self, text: str) -> None:
        """Adds a paragraph and prints it."""
        self.text(text)
        print(f"\n{text}")

    def picture(self, name: str, caption: str) -> None:
        """Adds a picture if the file exists."""
        if (self.folder / name).exists():
            self.text(f"![{caption.split('. ')[0].rstrip('.')}]({name})\n\n*{caption}*")

    def table(self, caption: str, rows: pd.DataFrame, is_shown: bool = False) -> None:
        """Adds a table unless it has no rows. Also prints it if `is_shown`; its cells must then be texts."""
        if len(rows):
            if is_shown:
                show(caption, rows)
            self.text(f"**{caption}**\n\n{markdown_table([list(rows), *rows.values.tolist()])}")

    def write(self, record: Path) -> None:
        """Writes the report. It ends with the machine and `record`, the driver's run.txt."""
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
        text = f"{_processor()}, {CORES} cores, {memory:.1f} GiB, {platform.platform()}\n"
        self.text("## The run\n\n```\n" + text + (record.read_text() if record.exists() else "") + "```")
        path = self.folder / "report.md"
        path.write_text("\n\n".join(self.blocks) + "\n", encoding="utf-8")
        print(f"\nReport: {path}")


def markdown_table(lines: list[list]) -> str:
    """Returns a table in Markdown. The first line is the header."""
    header, *rows = ("| " + " | ".join(map(str, line)) + " |" for line in lines)
    return "\n".join([header, "|---" * len(lines[0]) + "|", *rows])


def write_between(page: Path, name: str, lines: list[list]) -> None:
    """Writes a table, whose first line is the header, between the marks of that name on a page."""
    text = page.read_text(encoding="utf-8")
    start = text.index(mark := f"<!-- {name} -->\n") + len(mark)
    page.write_text(text[:start] + markdown_table(lines) + "\n" + text[text.index("<!-- end -->", start) :], encoding="utf-8")


def show(caption: str, rows: pd.DataFrame) -> None:
    """Prints a table whose cells are texts."""
    lines = [list(rows), *rows.values.tolist()]
    widths = [max(map(len, column)) for column in zip(*lines)]
    print(f"\n{caption}\n")
    for line in lines:
        print("  ".join(map(str.ljust, line, widths)).rstrip())


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()


def shared_cores(ranks: int) -> str:
    """Explains wall times if ranks share cores; empty if each rank has a core."""
    if ranks <= CORES:
        return ""
    return (
        f"{ranks} ranks share {CORES} cores: wall times show neither balance nor scaling. The"
        " critical path is what a run would take with a core for every rank: the processor time of"
        " the slowest rank of each step and rebalance outside MPI, and its messages on a network of"
        " 1.5 µs and 12 GB/s."
    )
