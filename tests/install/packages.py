#!/usr/bin/env python3
"""packages.py SOURCE: checks docs/install.md and README.md against tools/packages.txt.

Fails unless install.md has a row for each part that is more than tests, and the lines that install packages have
those of the library, and none that the table lacks.
"""
import re
import sys
from pathlib import Path


def rows_of(source):
    """Package, who needs it and what is left out without it, of each row."""
    for line in (source / "tools/packages.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            package, _, who, parts = (cell.strip() for cell in line.split("|"))
            yield package, who.split(", "), parts


def packages_of_parts(rows):
    """The packages of each part, in the order of the table."""
    packages = {}
    for package, _, parts in rows:
        for part in filter(None, parts.split(", ")):
            packages.setdefault(part, []).append(f"`{package}`")
    return packages


def problems(source):
    rows = list(rows_of(source))
    page = (source / "docs/install.md").read_text().splitlines()
    for part, packages in packages_of_parts(rows).items():
        row = f"| {part} | {', '.join(packages)} |"
        if not part.startswith(("test of ", "tests of ")) and row not in page:
            yield f"docs/install.md lacks\n{row}"
    for document in ("README.md", "docs/install.md"):
        text = (source / document).read_text().replace("\\\n", " ")
        lines = re.findall(r"apt-get install --yes ([a-z0-9+ .-]+)$", text, re.M)
        named = set(" ".join(lines).split())
        library = {package for package, who, _ in rows if "library" in who}
        if library - named or named - {package for package, _, _ in rows}:
            yield f"{document} installs {sorted(named)}, the library needs {sorted(library)}"


def main():
    found = list(problems(Path(sys.argv[1])))
    print(*found, sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
