#!/usr/bin/env python3
"""versions.py CACHE SOURCE: checks what packages repeat of the build and of the site.

Fails unless every file has the version of the build whose CMakeCache.txt is CACHE, and packages the address
of docs/conf.py.
"""
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
    ("tests/consumer/CMakeLists.txt", "find_package(rrcb {1} REQUIRED"),
]

# Each file, and the beginning of its line with the address of the project.
ADDRESSES = [
    ("packaging/debian/control", "Homepage: https://"),
    ("packaging/debian/copyright", "Source: https://"),
    ("packaging/debian/watch", "https://"),
]


def wrong_versions(source, version):
    numbers = version.split(".")
    names = version, ".".join(numbers[:2] if numbers[0] == "0" else numbers[:1])
    for file, line in VERSIONS:
        path = source / file.format(*names)
        lines = path.read_text().splitlines() if path.exists() else []
        if not any(text.startswith(line.format(*names)) for text in lines):
            yield f"{path} does not have '{line.format(*names)}'"


def wrong_addresses(source):
    """Lines of packages that have another address of the project than the site."""
    host = re.search(r'^html_baseurl = "https://([^/"]+)', (source / "docs/conf.py").read_text(), re.M)[1]
    for file, line in ADDRESSES:
        address = re.search(rf"^ *{re.escape(line)}(\S+)", (source / file).read_text(), re.M)
        if not address or not address[1].startswith(host):
            yield f"{source / file} does not have '{line}{host}', as docs/conf.py"


def main():
    cache, source = Path(sys.argv[1]).read_text(), Path(sys.argv[2])
    version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.*)$", cache, re.M)[1]
    problems = [*wrong_versions(source, version), *wrong_addresses(source)]
    print("\n".join(problems) or f"version {version} everywhere")
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())
