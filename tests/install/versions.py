#!/usr/bin/env python3
"""versions.py CACHE SOURCE: fails unless every file has the version of the build whose CMakeCache.txt is CACHE."""
import re
import sys
from pathlib import Path

# Each file, and its line with the version, {0}, or with that of the interface, {1}.
VERSIONS = [
    ("CHANGELOG.md", "## {0}"),
    ("CITATION.cff", "version: {0}"),
    ("packaging/debian/changelog", "rrcb ({0}-"),
    ("packaging/debian/control", "Package: librrcb{1}"),
    ("packaging/debian/control", "Package: librrcb-zoltan{1}"),
    ("packaging/debian/librrcb{1}.install", "usr/lib/*/librrcb.so.*"),
    ("packaging/debian/librrcb-zoltan{1}.install", "usr/lib/*/librrcb_zoltan.so.*"),
    ("packaging/debian/librrcb{1}.symbols", "librrcb.so.{1} librrcb{1} "),
    ("packaging/debian/librrcb-zoltan{1}.symbols", "librrcb_zoltan.so.{1} librrcb-zoltan{1} "),
    ("python/rrcb/_library.py", 'VERSION = "{1}"'),
    ("tests/consumer/CMakeLists.txt", "find_package(rrcb {1} REQUIRED)"),
]


def wrong_versions(source, version):
    names = version, version.rsplit(".", 1)[0]
    for file, line in VERSIONS:
        path = source / file.format(*names)
        lines = path.read_text().splitlines() if path.exists() else []
        if not any(text.startswith(line.format(*names)) for text in lines):
            yield f"{path} does not have '{line.format(*names)}'"


def main():
    cache, source = Path(sys.argv[1]).read_text(), Path(sys.argv[2])
    version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.*)$", cache, re.M)[1]
    problems = [*wrong_versions(source, version)]
    print("\n".join(problems) or f"version {version} everywhere")
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())
