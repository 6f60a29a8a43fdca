#!/usr/bin/env python3
"""symbols.py LIBRARY LIST... -- HEADER...: compares what a shared library shows with headers and lists.

Fails unless each function that a header declares, and no other, is shown; methods count for their
class. Of classes no more is shown than their type information and tables. The lists name what is shown,
one name at the start of each line. A function of a namespace detail is shown only for a header that calls it.
"""
import re
import subprocess
import sys
from pathlib import Path

TYPE_DATA = re.compile(r"(typeinfo|typeinfo name|vtable) for rrcb::(\w+)$")

# What rrcb/experimental declares, and what its headers call of rrcb/detail.
EXPERIMENTAL = re.compile(r"rrcb::experimental::|rrcb_(cost_model_|join_keys|ghosts_verify)"
                          r"|rrcb::(PointPasses|balance\(rrcb::PointPasses|(num_cells|cell_box|summary_of)\()")

# What has no body in the library.
ELSEWHERE = re.compile(r"(template|using|typedef|static_assert|constexpr|inline|friend)\b"
                       r"|.*=\s*(0|default|delete)$", re.S)


def version_of(symbol):
    """The beginning of the version that a symbol has: of the interface, or of what has no promise."""
    if EXPERIMENTAL.search(symbol):
        return "RRCB_EXPERIMENTAL_"
    return "RRCB_CPP_" if "rrcb::" in symbol else "RRCB_C_"


def shown_by(library):
    """Names without arguments, and classes whose type information is shown."""
    text = subprocess.run(["nm", "--dynamic", "--demangle", "--defined-only", library],
                          check=True, capture_output=True, text=True).stdout
    names, classes = set(), set()
    for line in text.splitlines():
        kind, symbol = line.split(maxsplit=2)[1:]
        symbol, _, version = symbol.partition("@@")
        if kind == "A":  # the name of a version
            continue
        if not version.startswith(version_of(symbol)):
            sys.exit(f"{symbol} has the version '{version}'")
        if match := TYPE_DATA.match(symbol):
            classes.add(match[2])
        else:
            names.add(re.sub(r"\(.*", "", symbol).replace("[abi:cxx11]", ""))
    return names, classes


def bare(text):
    """Text of a header without comments, directives and empty defaults."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r"^#.*?[^\\]$", "", text, flags=re.M)
    return re.sub(r"=\s*\{\}|\[\[nodiscard\]\]", "", text).replace('extern "C" {', "")


def statements(text):
    """(scope, statement) for each declaration that ends with a semicolon, scope "rrcb::Class"."""
    scopes, start, depth_inside = [], 0, 0
    for at, letter in enumerate(text):
        if depth_inside:
            depth_inside += {"{": 1, "}": -1}.get(letter, 0)
            if depth_inside == 0:
                start = at + 1
        elif letter == "{":
            head = text[start:at].strip()
            scope = re.match(r"(?:namespace|class|struct)\s+(?:\w+_API\s+)?([\w:]+)", head)
            if scope:
                scopes.append(scope[1])
                start = at + 1
            else:
                depth_inside = 1
        elif letter == "}":
            if scopes:
                scopes.pop()
            start = at + 1
        elif letter == ";":
            yield "::".join(scopes), text[start:at].strip()
            start = at + 1


def declared_in(headers):
    """Names of functions with a body elsewhere, and of classes."""
    functions, classes = set(), set()
    for header in headers:
        text = bare(Path(header).read_text())
        classes |= set(re.findall(r"\bclass\s+(?:\w+_API\s+)?(\w+)", text))
        for scope, statement in statements(text):
            statement = re.sub(r"\b(public|private|protected):|\[\[\w+\]\]", "", statement).strip()
            if scope and not scope.startswith("rrcb"):
                continue
            match = re.match(r"[\w:&*<>,\s]*?(operator=|~?\w+)\s*\(", statement)
            if not match or ELSEWHERE.match(statement):
                continue
            if Path(header).parent.name == "detail" and scope == "rrcb" and "RRCB_API" not in statement:
                continue  # for the library alone
            functions.add(f"{scope}::{match[1]}" if scope else match[1])
    return functions, classes


def listed_in(files):
    """Names at the start of lines, without the version that follows in a list of Debian."""
    text = "\n".join(Path(file).read_text() for file in files)
    return set(re.findall(r"^ *(rrcb(?:_|::)[\w:~=]+)", text, re.M))


def uncalled(names, headers):
    """Names of a namespace detail that headers declare, but do not call."""
    text = "\n".join(bare(Path(header).read_text()) for header in headers)
    last = {name: name.rpartition("::")[2] for name in names if "::detail::" in name}
    return [name for name, word in last.items() if len(re.findall(rf"\b{word}\(", text)) < 2]


def main():
    split = sys.argv.index("--")
    library, *lists = sys.argv[1:split]
    headers = sys.argv[split + 1:]
    shown, shown_classes = shown_by(library)
    declared, classes = declared_in(headers)
    problems = [f"declared, but not shown: {name}" for name in sorted(declared - shown)]
    problems += [f"shown, but in no header: {name}" for name in sorted(shown - declared)]
    problems += [f"shown, but no class of a header: {name}" for name in shown_classes - classes]
    listed = listed_in(lists)
    problems += [f"shown, but in no list: {name}" for name in shown - listed]
    problems += [f"in a list, but not shown: {name}" for name in listed - shown]
    problems += [f"shown, but called by no header: {name}" for name in uncalled(shown, headers)]
    print("\n".join(sorted(problems)) or f"{len(declared)} functions are declared and shown")
    return 1 if problems or not declared else 0


if __name__ == "__main__":
    sys.exit(main())
