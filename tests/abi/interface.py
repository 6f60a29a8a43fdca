#!/usr/bin/env python3
"""interface.py SOURCE CC [--write]: compares the interface in C with tests/abi/interface.txt.

The table lists what a compiled program relies on: values of enumerations, members of structs with their
offsets and types on 64-bit machines, and functions. A struct with a size may get more members at its end; no
other line may change. The types of Fortran and the structures of Python are compared with the structs. --write
writes the table.
"""
import ctypes
import importlib.util
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "install"))
from symbols import bare

PADDED = "bytes follow the last member of"
TABLE = Path(__file__).with_name("interface.txt")
# Types of Fortran with another name than in C.
RENAMED = {"plan": "plan_lists"}


def texts(source):
    """Headers in C without comments."""
    files = sorted((source / "include/rrcb/c").glob("*.h"))
    files += [source / "include/rrcb/rrcb.h", source / "src/c/for_fortran.h"]
    return "\n".join(bare(file.read_text()) for file in files)


def structs(text):
    """{struct: [(member, declaration)]}"""
    found = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\n\} \1;", text, re.S):
        declarations = [" ".join(each.split()) for each in body.split(";") if each.strip()]
        found[name] = [(re.search(r"\(\*(\w+)\)|(\w+)(?:\[\d+\])?$", each), each) for each in declarations]
        found[name] = [(match[1] or match[2], each) for match, each in found[name]]
    return found


def functions(text):
    """Declarations of functions in a library."""
    return sorted(" ".join(each.split()) for each in re.findall(r"RRCB_API ([^;{]*\));", text))


def program_of(text):
    """A program in C that prints the table of structs and enumerations."""
    lines = []
    for names in re.findall(r"typedef enum \w+ \{(.*?)\}", text, re.S):
        for name in re.findall(r"\b(RRCB_\w+)", names):
            lines.append(f'printf("{name} %d\\n", {name});')
    for struct, members in structs(text).items():
        for name, declaration in members:
            lines.append(f'printf("{struct} %zu %s\\n", offsetof({struct}, {name}), "{declaration}");')
        lines.append(f'printf("{struct} %zu end\\n", sizeof({struct}));')
        last = members[-1][0]
        lines.append(f"if (offsetof({struct}, {last}) + sizeof((({struct}*)0)->{last}) < sizeof({struct})) "
                     f'printf("{PADDED} {struct}\\n");')
    return ("#include <rrcb/rrcb.h>\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n" +
            "\n".join(lines) + "\nreturn 0;\n}\n")


def printed(source, compiler, text):
    """Lines of the table. MPI is needed for the types in declarations only."""
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder)
        (here / "rrcb").mkdir()
        (here / "rrcb/version.h").touch()
        (here / "mpi.h").write_text("typedef void* MPI_Comm;\n")
        (here / "print.c").write_text(program_of(text))
        subprocess.run([compiler, "-Wall", "-Werror", f"-I{source}/include", f"-I{here}", here / "print.c",
                        "-o", here / "print"], check=True)
        return subprocess.run([here / "print"], check=True, capture_output=True, text=True).stdout.splitlines()


def of_fortran(source):
    """{struct: (names of members, value of the member size)} of interoperable types."""
    found = {}
    for file in (source / "src/fortran").glob("*types.f90"):
        text = re.sub(r"!.*|&\n", "", file.read_text())
        for name, body in re.findall(r"type(?:, public)?, bind\(c\) :: (?:c|rrcb)_(\w+)\n(.*?)end type", text, re.S):
            declared = " , ".join(re.findall(r"::(.*)", body))
            names = re.findall(r"(?:^|,)\s*(\w+)(?:\(\d\))?\s*(?==|,|$)", declared)
            size = re.search(r"\bsize = (\d+)", body)
            found["rrcb_" + RENAMED.get(name, name)] = (names, size and int(size[1]))
    return found


def of_python(source):
    """{struct: (names of members, value of the member size)}"""
    path = source / "python/rrcb/_interface.py"
    module = importlib.util.module_from_spec(spec := importlib.util.spec_from_file_location("interface", path))
    spec.loader.exec_module(module)
    found = {}
    for kind in vars(module).values():
        if isinstance(kind, type) and issubclass(kind, ctypes.Structure) and "rrcb_" in (kind.__doc__ or ""):
            fields = [field[0].rstrip("_") for each in reversed(kind.mro()) for field in vars(each).get("_fields_", ())]
            found[kind.__doc__.rstrip(".")] = (fields, ctypes.sizeof(kind) if fields[0] == "size" else None)
    return found


def wrong_copies(text, sizes, language, found):
    """Types of another language that are not those of C."""
    declared = {name: [member for member, _ in members] for name, members in structs(text).items()}
    for name, (members, size) in found.items():
        if name in declared and members != declared[name]:
            yield f"{name} in {language} has the members {members}, in C {declared[name]}"
        if name in declared and members[0] == "size" and size != sizes[name]:
            yield f"{name} in {language} has the size {size}, in C {sizes[name]}"


def main():
    source, compiler = Path(sys.argv[1]), sys.argv[2]
    text = texts(source)
    made = printed(source, compiler, text)
    sizes = {line.split()[0]: int(line.split()[1]) for line in made if line.endswith(" end")}
    growing = {line.split()[0] for line in made if line.endswith(" 0 size_t size")}
    problems = [line for line in made if line.startswith(PADDED)]
    made = [line for line in made if line not in problems and
            (line.split()[0] not in growing or not line.endswith(" end"))]
    made += functions(text)
    if "--write" in sys.argv:
        TABLE.write_text("\n".join(made) + "\n")
        return 0
    promised = TABLE.read_text().splitlines()
    problems += [f"compiled programs rely on: {line}" for line in promised if line not in made]
    problems += [f"new, add it by --write: {line}" for line in made if line not in promised]
    for language, found in (("Fortran", of_fortran(source)), ("Python", of_python(source))):
        problems += wrong_copies(text, sizes, language, found)
        problems += [f"no types of {language} were found"] * (not found)
    print("\n".join(problems) or f"{len(made)} lines, {len(growing)} structs that can grow")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
