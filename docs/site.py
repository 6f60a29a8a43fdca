#!/usr/bin/env python3
"""site.py FOLDER: gathers the documents and the reference in FOLDER, for Sphinx.

Fails if a header of the interface has no place in the reference.
"""
import re
import shutil
import sys
from pathlib import Path

import reference

ROOT = Path(__file__).resolve().parents[1]
MENU = {
    "Start": ["docs/install", "docs/first_program", "docs/python", "docs/zoltan"],
    "Guide": ["docs/loop", "docs/queries", "docs/rebalancing", "docs/weights", "docs/choosing", "docs/machines",
              "docs/performance", "docs/hosts", "docs/errors", "docs/hard_cases", "docs/teuchos",
              "SUPPORT"],
    "Reference": ["docs/parameters", "reference/cpp", "reference/c", "reference/fortran",
                  "CHANGELOG"],
    "Comparisons": ["comparisons/README", "comparisons/columns", "docs/design/paper"],
    "Design": ["docs/design/how_it_works", "docs/design/statistical_domain",
               "docs/design/many_ranks", "docs/design/rebalancing", "docs/design/testing",
               "docs/design/xsdk", "CONTRIBUTING", "SECURITY"],
    "Examples": ["examples/lammps/README", "examples/mpm/README",
                 "examples/mpm/docs/method", "examples/mpm/docs/energy",
                 "examples/mpm/docs/scene_files", "examples/mpm/docs/parallel"],
}


def add_others():
    """Adds documents that the menu does not name to the guide."""
    named = {page for pages in MENU.values() for page in pages}
    for path in sorted((ROOT / "docs").glob("*.md")):
        name = f"docs/{path.stem}"
        if name not in named:
            MENU["Guide"].append(name)


def menu():
    """Tables of contents that Sphinx shows in the margin."""
    return "".join(f"\n```{{toctree}}\n:hidden:\n:caption: {group}\n\n" + "\n".join(pages) + "\n```\n"
                   for group, pages in MENU.items())


def pictures_of(text):
    return re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)


def without_sources(text):
    """Links to files of the source that are no pages become text."""
    return re.sub(r"(?<!!)\[([^\]]+)\]\((?!\w+:|#|[^)]*\.md[#)])[^)]+\)", r"\1", text)


def gather(folder):
    for name in ["README", *(page for pages in MENU.values() for page in pages)]:
        source = ROOT / f"{name}.md"
        if name.startswith("reference/"):
            continue
        target = folder / f"{name}.md"
        target.parent.mkdir(parents=True, exist_ok=True)
        text = without_sources(source.read_text())
        target.write_text(text + menu() if name == "README" else text)
        for picture in pictures_of(text):
            place = target.parent / picture
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source.parent / picture, place)
    for name, text in reference.pages(ROOT).items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    shutil.copy(ROOT / "docs" / "conf.py", folder)
    shutil.copy(ROOT / "docs" / "site.css", folder)


def without_place():
    """Headers that the reference lacks."""
    named = {f"{name}.hpp" for name in reference.CPP} | {f"{name}.h" for name in reference.C}
    include = ROOT / "include" / "rrcb"
    for path in include.rglob("*.h*"):
        name = str(path.relative_to(include))
        if name not in (*named, "export.h") and "RRCB_API " in path.read_text():
            yield f"docs/reference.py: no place for {name}"


def main():
    folder = Path(sys.argv[1])
    problems = list(without_place())
    if problems:
        sys.exit("\n".join(problems))
    add_others()
    gather(folder)


if __name__ == "__main__":
    main()
