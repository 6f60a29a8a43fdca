#!/usr/bin/env python3
"""names.py SOURCE [--table]: compares the functions of the interface in C++, C, Fortran and Python.

Fails unless each function that rrcb/rrcb.hpp declares is in the other languages, and no other is in C
and Fortran, except those listed here with a reason. --table prints the names as a table in Markdown.
"""
import ast
import re
import sys
from pathlib import Path

from symbols import bare

# Functions in C++ under another name in C.
RENAMED = {
    "ghost_plan": "rrcb_ghosts_create",
    "fetch": "rrcb_ghosts_fetch",
    "reply": "rrcb_ghosts_reply",
    "accumulate": "rrcb_ghosts_accumulate",
    "apply_shifts": "rrcb_ghosts_apply_shifts",
    "groups": "rrcb_groups_create",
    "group_sums": "rrcb_groups_sums",
    "to_points": "rrcb_groups_to_points",
    "save": "rrcb_save_cuts",  # and of the handles
    "load": "rrcb_load_cuts",
}
# Functions in C++ alone; a class stands for its methods.
ONLY_CPP = {
    "balance_into": "rrcb_balance keeps memory with the balancer",
    "column": "rrcb_column is a struct",
    "columns": "an array of rrcb_column",
    "transfer_in_place": "changes the length of vectors",
    "is_above": "rrcb_part_of descends by it",
    "TreeShape": "for those who descend themselves",
    "ghosts_of": "an array of rrcb_column",
    "Points": "rrcb_points is a struct",
    "RankRange": "a shorthand for members of a struct",
    "AxisOrder": "axes.order is for C++ only",
    "GhostArrays": "made by ghosts_of",
    "Cutoff": "a number or an array",
    "Cuts": "rrcb_get_cuts fails without cuts",
    "unstamped": "a balancer has one communicator",
    "Error": "rrcb_code and rrcb_last_error",
    "Neighbours::fail": "programs in other languages agree on their own errors",
}
# Functions in C alone: a handle holds what is an argument or a result in C++.
ONLY_C = {
    "rrcb_balancer_create", "rrcb_balancer_destroy", "rrcb_balancer_set", "rrcb_balancer_set_part_sizes", "rrcb_set_cuts",
    "rrcb_get_cuts", "rrcb_get_plan", "rrcb_get_report", "rrcb_ghosts_destroy",
    "rrcb_ghosts_get_plan", "rrcb_groups_destroy",
    "rrcb_neighbours_apply_shifts",  # of its ghost_plan()
    "rrcb_interleaved_points", "rrcb_column_points",  # constructors of Points
    "rrcb_assign_all",  # an overload of assign
    "rrcb_last_error",  # the text of an Error
    "rrcb_controller_save", "rrcb_controller_load",
}
# Functions in C that are no procedure of their own in Fortran.
NOT_FORTRAN = {}
# Procedures of Fortran alone.
ONLY_FORTRAN = {"rrcb_array%take", "rrcb_array%give",  # C reads its struct
                "rrcb_balancer%clear_cuts"}  # rrcb_set_cuts(balancer, NULL)
# Functions in C that Fortran does not call, but has as its own.
OWN_OF_FORTRAN = {"rrcb_interleaved_points", "rrcb_column_points"}
# Functions in Python with another name, or as a method.
PYTHON = {
    "assign": "Cuts.part_of", "part_of": "Cuts.part_of",
    "box_of": "Cuts.boxes", "transfer": "Plan.transfer",
    "ghost_plan": "Distribution.ghosts", "fetch": "Ghosts.fetch", "reply": "Ghosts.reply",
    "accumulate": "Ghosts.accumulate",
    "apply_shifts": "Ghosts.fetch_positions",
    "group_sums": "Groups.sums", "to_points": "Groups.to_points", "remap": "Distribution.remap", "save": "Cuts.save",
    "load": "Cuts.load", "part_weights": "Distribution.part_weights",
    "moved_fraction": "Distribution.moved_fraction", "Groups::points": "Groups.x",
    "Neighbours::ghost_plan": "Neighbours.sent", "version": "__version__",
}
NOT_PYTHON = {
    "Neighbours::~Neighbours": "freed with the object",
    "bounding_box": "numpy has it", "imbalance": "numpy has it",
    "ranks_of_part": "remap() and ghosts() apply it",
    "release_buffers": "buffers are freed with the communicator",
    "parts_touching": "ghosts() finds points",
}
CLASSES = {"Controller": "controller", "Groups": "groups",
           "Neighbours": "neighbours"}
HANDLES = ["balancer", "controller", "ghosts", "groups", "neighbours"]


def declarations(text):
    """(scope, access, head) of each declaration of a header, without nested bodies."""
    scopes, access, start, skipped = [], ["public"], 0, 0
    for at, letter in enumerate(text):
        if skipped:
            skipped += {"{": 1, "}": -1}.get(letter, 0)
            start = at + 1
            continue
        if letter not in "{};":
            continue
        head = text[start:at]
        for label in re.findall(r"\b(public|private|protected)\s*:", head):
            access[-1] = label
        head = re.sub(r"\b(public|private|protected)\s*:", "", head).strip()
        start = at + 1
        scope = re.match(r"(?:template\s*<.*?>\s*)?(namespace|class|struct)\s+(?:\w+_API\s+)?(\w+)",
                         head, re.S)
        if letter == "{" and scope and scope[2] != "detail":
            scopes.append(scope[2])
            access.append("private" if scope[1] == "class" else "public")
        elif letter == "{":
            yield scopes[1:], access[-1], head
            skipped = 1
        elif letter == "}":
            if scopes:
                scopes.pop()
                access.pop()
        else:
            yield scopes[1:], access[-1], head


def headers_of(folder, name, found):
    """Adds a header and those that it includes to `found`."""
    found[name] = folder / name
    for included in re.findall(r"#include <(rrcb/\w+\.hpp)>", found[name].read_text()):
        if included not in found:
            headers_of(folder, included, found)
    return found.values()


def functions_of_cpp(headers):
    """Names of functions and methods, "Class::method"."""
    names = set()
    for header in headers:
        for scope, access, head in declarations(bare(header.read_text())):
            head = re.sub(r"template\s*<[^()]*>\s*(requires\s*\([^()]*\))?\s*(?=\w)", "", head)
            name = re.match(r"[^=(]*?(~?\w+)\s*\(", head)
            if not name or access != "public" or re.search(r"\b(operator|friend)\b", head):
                continue
            if re.match(r"(static_assert|using|namespace|enum)\b", head):
                continue
            names.add("::".join(scope + [name[1]]))
    return names


def expected_in_c(name):
    """Name in C of a function in C++; None if it is in C++ alone."""
    scope, _, method = name.rpartition("::")
    if scope in ONLY_CPP or name in ONLY_CPP:
        return None
    if not scope:
        return RENAMED.get(name, f"rrcb_{name}")
    method = {scope: "create", f"~{scope}": "destroy"}.get(method, method)
    return f"rrcb_{CLASSES.get(scope, scope)}_{method}"


def expected_in_fortran(name):
    """Names of which one stands in Fortran for a function in C."""
    for handle in HANDLES:
        if name.startswith(f"rrcb_{handle}_"):
            return {f"rrcb_{handle}%" + name.removeprefix(f"rrcb_{handle}_")}
    return {"rrcb_balancer%" + name.removeprefix("rrcb_"), name}


def procedures_of_fortran(folder):
    """Public names of the module rrcb, and "type%binding" of its types."""
    names = set()
    for file in {*folder.iterdir()} - {folder / "experimental.F90"}:
        text = re.sub(r"!.*", "", file.read_text())
        for kind, body in re.findall(r"type, public :: (rrcb_\w+)\n(.*?)\n  end type", text, re.S):
            names |= {f"{kind}%{binding}" for binding in
                      re.findall(r"^ *(?:procedure|generic) :: (\w+)", body, re.M)}
    module = re.sub(r"!.*|&\n", "", (folder / "rrcb.f90").read_text())
    for line in re.findall(r"use \w+, only: (.*)", module):
        names |= {name.strip() for name in line.split(",")}
    return names


def names_of_python(package):
    """Names that the package exports, and "Class.member" of its classes with those inherited."""
    members, bases, names = {}, {}, {"__version__"}
    for file in package.glob("*.py"):
        for node in ast.parse(file.read_text()).body:
            if isinstance(node, ast.ClassDef):
                bases[node.name] = [base.id for base in node.bases if isinstance(base, ast.Name)]
                members[node.name] = {
                    each.target.id if isinstance(each, ast.AnnAssign) else each.name
                    for each in node.body if isinstance(each, (ast.FunctionDef, ast.AnnAssign))}
    text = (package / "__init__.py").read_text()
    for name in ast.literal_eval(re.search(r"__all__ = (\[.*?\])", text, re.S)[1]):
        names.add(name)
        kinds = [name]
        for kind in kinds:
            names |= {f"{name}.{member}" for member in members.get(kind, ())}
            kinds += bases.get(kind, ())
    return names


def expected_in_python(name):
    """Name in Python of a function in C++; None if it has none."""
    scope, _, method = name.rpartition("::")
    if name in PYTHON:
        return PYTHON[name]
    if scope in ONLY_CPP or name in ONLY_CPP or name in NOT_PYTHON:
        return None
    if method == scope:
        return scope
    return f"{scope}.free" if method.startswith("~") else f"{scope}.{method}".lstrip(".")


def table(cpp, fortran):
    """Rows of the names of one function in the four languages."""
    yield from ("| C++ | C | Fortran | Python |", "|---|---|---|---|")
    for name in sorted(cpp, key=lambda each: (each.rpartition("::")[0], each)):
        in_c = expected_in_c(name)
        if in_c is None:
            continue
        in_fortran = sorted(expected_in_fortran(in_c) & fortran)
        row = [name, in_c, in_fortran[0] if in_fortran else None, expected_in_python(name)]
        yield "| " + " | ".join(f"`{each}`" if each else "" for each in row) + " |"


def main():
    source = Path(sys.argv[1])
    include = source / "include/rrcb"
    cpp = functions_of_cpp(headers_of(source / "include", "rrcb/rrcb.hpp", {}))
    text = bare("".join(file.read_text() for file in [include / "rrcb.h", *include.glob("c/*.h")]))
    c = set(re.findall(r"\b(rrcb_\w+)\(", text))
    in_module = set(re.findall(r'name="(rrcb_\w+)"', "".join(
        file.read_text() for file in (source / "src/fortran").glob("c_*.f90"))))
    fortran = procedures_of_fortran(source / "src/fortran")

    wanted_c = {expected_in_c(name): name for name in cpp} | {name: name for name in ONLY_C}
    wanted_c.pop(None, None)
    problems = [f"{wanted_c[name]} is not in C, as {name}" for name in wanted_c.keys() - c]
    problems += [f"{name} is not in C++" for name in c - wanted_c.keys()]
    called = {name.removesuffix("_fortran") for name in in_module}
    problems += [f"{name} is not called from Fortran" for name in c - called - OWN_OF_FORTRAN]
    wanted = {name: expected_in_fortran(name) for name in c - NOT_FORTRAN.keys()}
    problems += [f"{name} is not in Fortran, as {' or '.join(sorted(each))}"
                 for name, each in wanted.items() if not each & fortran]
    allowed = set().union(*wanted.values())
    types = {name.lower() for name in re.findall(r"\brrcb_\w+", text, re.I)}
    problems += [f"{name} of Fortran is not in C" for name in fortran - allowed - types - ONLY_FORTRAN]
    in_python = {name: expected_in_python(name) for name in cpp}
    python = names_of_python(source / "python/rrcb")
    problems += [f"{name} is not in Python, as {each}" for name, each in in_python.items()
                 if each and each not in python]
    problems += [f"the exception {name} is not needed"
                 for name in (PYTHON.keys() | NOT_PYTHON.keys()) - cpp]
    if "--table" in sys.argv:
        print("\n".join(table(cpp, fortran)))
        return 0
    exceptions = ONLY_CPP.keys() - cpp - {name.split("::")[0] for name in cpp}
    problems += [f"the exception {name} is not needed" for name in exceptions | (ONLY_C - c)]
    print("\n".join(sorted(problems)) or
          f"{len(cpp)} functions in C++, {len(c)} in C, {len(fortran & allowed)} procedures in "
          f"Fortran, and {len(set(in_python.values()) - {None})} names in Python")
    return 1 if problems or not cpp else 0


if __name__ == "__main__":
    sys.exit(main())
