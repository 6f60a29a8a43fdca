#!/usr/bin/env python3
"""examples.py SOURCE [PREFIX FOLDER GENERATOR EXAMPLE...]: checks that every folder of examples is a project of its own.

Fails unless each folder with a CMakeLists.txt, except that of Python, finds the installed library, and examples/README.md
has its row. With the prefix of an installed library, the named examples are also configured in FOLDER. Nothing is
compiled: the build compiles the same sources.
"""
import re
import subprocess
import sys
from pathlib import Path

NEEDED = (r"^cmake_minimum_required\(", r"^project\(", r"^find_package\(rrcb ")
NO_PROJECTS = {"python"}


def folders_of(source):
    return sorted(file.parent for file in (source / "examples").glob("*/CMakeLists.txt")
                  if file.parent.name not in NO_PROJECTS)


def faults_of_text(source):
    page = (source / "examples/README.md").read_text()
    for folder in folders_of(source):
        text = (folder / "CMakeLists.txt").read_text()
        yield from (f"{folder}: no line {line}" for line in NEEDED if not re.search(line, text, re.M))
        if f"| `{folder.name}` |" not in page:
            yield f"examples/README.md has no row for {folder.name}"


def faults_of_configuring(source, prefix, build, generator, names):
    for folder in folders_of(source):
        if folder.name not in names:
            print(f"{folder.name}: left out, as in the build")
            continue
        done = subprocess.run(["cmake", "-S", folder, "-B", Path(build, folder.name), "-G", generator,
                               f"-DCMAKE_PREFIX_PATH={prefix}"], capture_output=True, text=True)
        if done.returncode != 0:
            yield f"{folder.name}:\n{done.stdout}{done.stderr}"


def main():
    source, *installed = sys.argv[1:]
    problems = [*faults_of_text(Path(source))]
    if installed:
        prefix, build, generator, *names = installed
        problems += faults_of_configuring(Path(source), prefix, build, generator, names)
    print("\n".join(problems) or f"{len(folders_of(Path(source)))} examples are projects")
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())
