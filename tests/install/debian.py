#!/usr/bin/env python3
"""debian.py PREFIX SOURCE: fails unless SOURCE/packaging/debian packages each file installed under PREFIX,
once, except those for Teuchos, which the packages leave out.
"""
import re
import sys
from pathlib import Path


def packaged_as(path):
    """Returns the path of an installed file in Debian, where each architecture has a folder of libraries."""
    return Path(re.sub("^lib(64|/[^/]+-linux-gnu)?/", "lib/ARCHITECTURE/", str(path)))


def main():
    prefix, source = Path(sys.argv[1]), Path(sys.argv[2])
    patterns = [word.removeprefix("usr") for file in (source / "packaging/debian").glob("*.install")
                for word in file.read_text().split() if word.startswith("usr/")]
    files = [path.relative_to(prefix) for path in prefix.rglob("*") if not path.is_dir()]
    wrong = []
    for file in files:
        name = "/" / packaged_as(file)
        times = sum(any(path.match(pattern) for path in [name, *name.parents]) for pattern in patterns)
        if times != 1 and "teuchos" not in str(name).lower():
            wrong.append(f"packaging/debian/*.install have {times} patterns for {file}, not 1")
    print("\n".join(wrong) or f"{len(files)} files, each in one package")
    return len(wrong) > 0 or not files


if __name__ == "__main__":
    sys.exit(main())
