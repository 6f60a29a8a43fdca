#!/usr/bin/env python3
"""spack.py RECIPE CACHE FOLDER: checks the recipe for Spack without Spack.

Fails unless the options that it sets are those of the build whose CMakeCache.txt is CACHE, each
variant sets one, conditions name variants that exist, the version is the project's, and what the
recipe tests is a folder of the source FOLDER.
"""
import re
import sys
import types
from pathlib import Path


class Recorder(types.ModuleType):
    """In place of spack.package: notes what the recipe declares."""

    def __init__(self):
        super().__init__("spack.package")
        self.variants, self.conditions, self.versions, self.cached = {}, [], [], []
        self.__all__ = ["CMakePackage", "license", "version", "variant", "depends_on", "conflicts",
                        "run_after", "cache_extra_test_sources", "join_path", "Executable"]
        self.CMakePackage = Package
        self.license = self.conflicts = lambda *args, **named: None
        self.version = lambda number, **named: self.versions.append(number)
        self.variant = lambda name, **named: self.variants.update({name: named["default"]})
        self.depends_on = lambda spec, when="", **named: self.conditions.append(when)
        self.run_after = lambda phase: lambda method: method
        self.cache_extra_test_sources = lambda package, folder: self.cached.append(folder)
        self.join_path = self.Executable = None


class Package:
    def define(self, name, value):
        return name, None

    def define_from_variant(self, name, variant):
        return name, variant


def main():
    recipe, cache, folder = map(Path, sys.argv[1:])
    recorder = Recorder()
    sys.modules["spack"] = types.ModuleType("spack")
    sys.modules["spack.package"] = recorder
    scope = {}
    exec(compile(recipe.read_text(), recipe, "exec"), scope)
    package = scope["Rrcb"]()
    package.keep_the_consumer()
    options = package.cmake_args()

    known = set(re.findall(r"^(RRCB_\w+):", cache.read_text(), re.M)) | {"BUILD_SHARED_LIBS"}
    version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.*)$", cache.read_text(), re.M)[1]
    problems = [f"no option of the build: {name}" for name, _ in options if name not in known]
    problems += [f"variant without an option: {name}" for name in recorder.variants
                 if name not in [variant for _, variant in options]]
    problems += [f"option of no variant: {name}" for name, variant in options
                 if variant is not None and variant not in recorder.variants]
    problems += [f"condition on no variant: {when}" for when in recorder.conditions
                 if when and when.strip("+~") not in recorder.variants]
    if recorder.versions != [version]:
        problems.append(f"version {recorder.versions}, but the project is {version}")
    problems += [f"no folder to test: {name}" for name in recorder.cached
                 if not (folder / name / "CMakeLists.txt").exists()]
    print("\n".join(problems) or f"{len(options)} options, {len(recorder.variants)} variants")
    return 1 if problems or not recorder.variants or not recorder.cached else 0


if __name__ == "__main__":
    sys.exit(main())
