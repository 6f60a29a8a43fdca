#!/usr/bin/env python3
"""public_names.py SOURCE [--write]: compares the public names of C++ and C with public_names.txt.

A public name is one that a program can write: a function, a type, a public member, an enumerator or a
constant in namespace rrcb, by its scope. Overloads share a name; constructors and operators have none of
their own. In C it is a function. Headers in rrcb/experimental and rrcb/detail, and namespaces detail, promise
nothing and do not count. --write writes the file.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from names import declarations
from symbols import bare

TABLE = Path(__file__).with_name("public_names.txt")
MOST = {"C++": 260, "C": 60}
# What gives no name: definitions of others, and words that begin a line of two meanings.
NAMELESS = re.compile(r"(static_assert|friend|namespace|using namespace|class|struct)\b|.*\boperator\b", re.S)


def plain(head):
    """A declaration without its template head, constraints, attributes and arguments of templates."""
    head = re.sub(r"\brequires\s*(\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)|[\w:]+<[^<>]*>)", "", head)
    head = re.sub(r"\[\[.*?\]\]", "", head)
    while (shorter := re.sub(r"<[^<>()]*(\([^()]*\))?[^<>()]*>", "", head)) != head:
        head = shorter
    return re.sub(r"\btemplate\b", "", head).strip()


def names_in(head, scope):
    """Names that a declaration gives."""
    if using := re.match(r"using (\w+)\s*=", head):
        return [using[1]]
    if NAMELESS.match(head) or not re.match(r"(?!using|enum)[\w\[]", head):
        return []
    head = plain(head)
    if called := re.match(r"[^=(]*?(~?\w+)\s*\(", head):
        own = scope and called[1].lstrip("~") == scope[-1]
        return [] if own else [called[1]]
    last = re.search(r"(\w+)\s*(\[[^\]]*\])?\s*$", head.split("=")[0])
    return [last[1]] if last else []


def enumerators(text):
    """{enumeration: names of its values}"""
    found = re.findall(r"\benum(?: class)? (\w+)[^{;]*\{(.*?)\}", text, re.S)
    return {name: re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", values.strip()) for name, values in found}


def of_cpp(headers):
    """Public names in namespace rrcb."""
    names = set()
    for header in headers:
        text = bare(header.read_text())
        values = enumerators(text)
        for scope, access, head in declarations(text):
            if access != "public" or {"detail", "experimental"} & set(scope):
                continue
            names.update("::".join(scope[:k + 1]) for k in range(len(scope)))
            if enum := re.match(r"enum(?: class)? (\w+)", head):
                kind = "::".join([*scope, enum[1]])
                names |= {kind} | {f"{kind}::{value}" for value in values[enum[1]]}
            names |= {"::".join([*scope, name]) for name in names_in(head, scope)}
    return names


def of_c(headers):
    """Functions of C, those in the headers included."""
    return set(re.findall(r"\b(rrcb_\w+)\(", "".join(bare(header.read_text()) for header in headers)))


def main():
    include = Path(sys.argv[1]) / "include/rrcb"
    found = {"C++": of_cpp([*include.glob("*.hpp"), *include.glob("teuchos/*.hpp")]),
             "C": of_c([include / "rrcb.h", *include.glob("c/*.h")])}
    made = [f"{language} {name}" for language, names in found.items() for name in sorted(names)]
    if "--write" in sys.argv:
        TABLE.write_text("\n".join(made) + "\n")
        return 0
    promised = TABLE.read_text().splitlines()
    problems = [f"no longer public: {line}" for line in promised if line not in made]
    problems += [f"new, add it by --write: {line}" for line in made if line not in promised]
    problems += [f"{len(found[language])} names in {language}, at most {most}" for language, most in MOST.items()
                 if len(found[language]) > most]
    print("\n".join(problems) or ", ".join(f"{len(names)} names in {language}" for language, names in found.items()))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
