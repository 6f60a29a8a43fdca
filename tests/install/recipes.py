#!/usr/bin/env python3
"""recipes.py CACHE SOURCE: checks what packaging/ and others repeat of the build, without their tools.

Fails unless every file has the version of the build whose CMakeCache.txt is CACHE, and packages the address
of docs/conf.py; and the recipe for Spack, run with stubs of Spack's modules, sets options of that build, names
variants that exist and tests the installed package by a project of SOURCE.
"""
import os
import re
import sys
import types
from pathlib import Path

# Each file, and its line with the version, {0}, or with that of the interface, {1}.
VERSIONS = [
    ("CHANGELOG.md", "## {0}"),
    ("CITATION.cff", "version: {0}"),
    ("packaging/conda/recipe.yaml", '  version: "{0}"'),
    ("packaging/debian/changelog", "rrcb ({0}-"),
    ("packaging/debian/control", "Package: librrcb{1}"),
    ("packaging/debian/control", "Package: librrcb-zoltan{1}"),
    ("packaging/debian/librrcb{1}.install", "usr/lib/*/librrcb.so.*"),
    ("packaging/debian/librrcb-zoltan{1}.install", "usr/lib/*/librrcb_zoltan.so.*"),
    ("packaging/debian/librrcb{1}.symbols", "librrcb.so.{1} librrcb{1} "),
    ("packaging/debian/librrcb-zoltan{1}.symbols", "librrcb_zoltan.so.{1} librrcb-zoltan{1} "),
    ("python/rrcb/_library.py", 'VERSION = "{1}"'),
    ("packaging/spack/spack_repo/rrcb/packages/rrcb/package.py", '    version("{0}"'),
    ("tests/consumer/CMakeLists.txt", "find_package(rrcb {1} REQUIRED)"),
]

# Each file, and the beginning of its line with the address of the project.
ADDRESSES = [
    ("packaging/conda/recipe.yaml", "url: https://"),
    ("packaging/conda/recipe.yaml", "homepage: https://"),
    ("packaging/debian/control", "Homepage: https://"),
    ("packaging/debian/copyright", "Source: https://"),
    ("packaging/debian/watch", "https://"),
    ("packaging/spack/spack_repo/rrcb/packages/rrcb/package.py", 'homepage = "https://'),
    ("packaging/spack/spack_repo/rrcb/packages/rrcb/package.py", 'url = "https://'),
    ("packaging/spack/spack_repo/rrcb/packages/rrcb/package.py", 'git = "https://'),
]


def wrong_versions(source, version):
    names = version, version.rsplit(".", 1)[0]
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


class Recorder(types.ModuleType):
    """In place of spack.package: notes what the recipe declares."""

    def __init__(self):
        super().__init__("spack.package")
        self.variants, self.conditions, self.cached, self.commands = {}, [], [], []
        self.__all__ = ["license", "version", "variant", "depends_on", "conflicts", "requires", "run_after",
                        "cache_extra_test_sources", "join_path", "Executable", "get_cmake_prefix_path"]
        self.license = self.conflicts = self.requires = self.version = lambda *args, **named: None
        self.variant = lambda name, **named: self.variants.update({name: named["default"]})
        self.depends_on = lambda spec, when="", **named: self.conditions.append(when)
        self.run_after = lambda phase: lambda method: method
        self.cache_extra_test_sources = lambda package, folder: self.cached.append(folder)
        self.join_path = os.path.join
        self.Executable = lambda program: lambda *arguments: self.commands.append([program, *arguments])
        self.get_cmake_prefix_path = lambda package: ["prefix of Eigen"]


class Package:
    prefix = "prefix of RRCB"

    def __init__(self, source):
        binary = types.SimpleNamespace(cmake="cmake", ctest="ctest")
        self.spec = {"cmake": types.SimpleNamespace(prefix=types.SimpleNamespace(bin=binary))}
        self.test_suite = types.SimpleNamespace(current_test_cache_dir=source)

    def define(self, name, value):
        return name, value

    def define_from_variant(self, name, variant):
        return name, variant


def run_spack_recipe(source):
    recorder = Recorder()
    build_system = types.ModuleType("cmake")
    build_system.CMakePackage = Package
    for module in ("spack", "spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems"):
        sys.modules[module] = types.ModuleType(module)
    sys.modules["spack_repo.builtin.build_systems.cmake"] = build_system
    sys.modules["spack.package"] = recorder
    recipe = source / "packaging/spack/spack_repo/rrcb/packages/rrcb/package.py"
    scope = {}
    exec(compile(recipe.read_text(), recipe, "exec"), scope)
    package = scope["Rrcb"](source)
    package.keep_the_consumer()
    package.test_consumer()
    return recorder, package


def spack_problems(source, cache):
    recorder, package = run_spack_recipe(source)
    options = package.cmake_args()
    known = set(re.findall(r"^(RRCB_\w+):", cache, re.M)) | {"BUILD_SHARED_LIBS"}
    set_by = [variant for _, variant in options if isinstance(variant, str)]
    yield from (f"no option of the build: {name}" for name, _ in options if name not in known)
    yield from (f"variant without an option: {name}" for name in recorder.variants if name not in set_by)
    yield from (f"option of no variant: {name}" for name in set_by if name not in recorder.variants)
    yield from (f"condition on no variant: {when}" for when in recorder.conditions
                if when and when.strip("+~") not in recorder.variants)
    if not recorder.variants or not recorder.cached:
        yield "no variants or no tests"
    yield from (f"no folder to test: {name}" for name in recorder.cached
                if not (source / name / "CMakeLists.txt").exists())
    configured = ["cmake", "-S", *(str(source / name) for name in recorder.cached), "-B", "build",
                  ("CMAKE_PREFIX_PATH", ["prefix of RRCB", "prefix of Eigen"])]
    if not package.test_requires_compiler or configured not in recorder.commands:
        yield f"the test does not build the cached project: {recorder.commands}"
    if ["ctest", "--test-dir", "build", "--no-tests=error"] not in recorder.commands:
        yield f"the test does not run the cached project: {recorder.commands}"


def main():
    cache, source = Path(sys.argv[1]).read_text(), Path(sys.argv[2])
    version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.*)$", cache, re.M)[1]
    problems = [*wrong_versions(source, version), *wrong_addresses(source), *spack_problems(source, cache)]
    print("\n".join(problems) or f"version {version} everywhere; the recipe for Spack is in order")
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())
