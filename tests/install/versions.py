#!/usr/bin/env python3
"""versions.py VERSION SOURCE: checks what packages repeat of the build, and that no file has a placeholder.

Fails unless every file of the list has the version, and if a file has an address of .invalid or repeats a field that
only a release can fill: CITATION.cff alone has these.
"""
import re
import sys
from pathlib import Path

# Each file, and its line with the version, {0}, with that of the interface, {1}, or with that of Debian, {2}.
VERSIONS = [
    ("CHANGELOG.md", "## {0}"),
    ("CITATION.cff", "version: {0}"),
    ("packaging/debian/changelog", "rrcb ({2}-"),
    ("packaging/debian/control", "Package: librrcb{1}"),
    ("packaging/debian/control", "Package: librrcb-zoltan{1}"),
    ("packaging/debian/librrcb{1}.install", "usr/lib/*/librrcb.so.*"),
    ("packaging/debian/librrcb-zoltan{1}.install", "usr/lib/*/librrcb_zoltan.so.*"),
    ("packaging/debian/librrcb{1}.symbols", "librrcb.so.{1} librrcb{1} "),
    ("packaging/debian/librrcb{1}.symbols", " rrcb_balance@RRCB_C_1.0 "),
    ("packaging/debian/librrcb-zoltan{1}.symbols", "librrcb_zoltan.so.{1} librrcb-zoltan{1} "),
    ("python/rrcb/_library.py", 'VERSION = "{1}"'),
]

# Files with a field that tools/package fills from CITATION.cff, and the field.
FILLED = {"control": ("@EMAIL@", "@URL@"), "copyright": ("@URL@",), "watch": ("@URL@",), "changelog": ("@EMAIL@",)}


def wrong_versions(source, version):
    names = version, version.split(".")[0], version.replace("-", "~")
    for file, line in VERSIONS:
        path = source / file.format(*names)
        lines = path.read_text().splitlines() if path.exists() else []
        if not any(text.startswith(line.format(*names)) for text in lines):
            yield f"{path} does not have '{line.format(*names)}'"


def wrong_fields(source):
    for file, fields in FILLED.items():
        text = (source / "packaging/debian" / file).read_text()
        yield from (f"packaging/debian/{file} does not have {field}" for field in fields if field not in text)
    for file in [source / "docs/conf.py", *(source / "packaging/debian").glob("*"), source / "tools/release"]:
        if file.is_file() and re.search(r"\.invalid\b", file.read_text()):
            yield f"{file} has a placeholder; the field belongs in CITATION.cff"


def main():
    version, source = sys.argv[1], Path(sys.argv[2])
    problems = [*wrong_versions(source, version), *wrong_fields(source)]
    print("\n".join(problems) or f"version {version} everywhere")
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())
