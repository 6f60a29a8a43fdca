#!/usr/bin/env python3
"""site.py FOLDER: gathers the documents and the reference in FOLDER, for Sphinx.

Fails if a header of the interface has no place in the reference.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

import reference

ROOT = Path(__file__).resolve().parents[1]
MENU = {
    "Start": ["docs/install", "docs/first_program", "docs/languages", "docs/tutorial", "docs/python", "docs/zoltan"],
    "Guide": ["docs/loop", "docs/queries", "docs/rebalancing", "docs/weights", "docs/choosing",
              "docs/errors", "docs/hard_cases", "docs/teuchos",
              "SUPPORT"],
    "Reference": ["docs/parameters", "reference/cpp", "reference/c", "reference/fortran",
                  "reference/python", "reference/names", "docs/stability", "docs/migration", "CHANGELOG"],
    "Comparisons": ["comparisons/README", "comparisons/columns", "docs/design/paper"],
    "Design": ["docs/design/how_it_works", "docs/design/statistical_domain",
               "docs/design/many_ranks", "docs/design/rebalancing", "docs/performance",
               "docs/machines", "docs/hosts", "docs/design/testing",
               "docs/design/xsdk", "CONTRIBUTING", "SECURITY"],
    "Examples": ["examples/README", "examples/lammps/README", "examples/mpm/README",
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


def linked_names(text, links):
    """Names of functions and types in prose lead to the reference; code, headings and links stay."""
    def link(found):
        name = found[1].removesuffix("()").removeprefix("rrcb::")
        return f"[{found[0]}]({links[name]})" if name in links else found[0]
    parts = re.split(r"(```.*?```|^#.*?$|^    .*?$|!?\[[^\]]*\]\([^)]*\))", text, flags=re.S | re.M)
    return "".join(part if k % 2 else re.sub(r"(?<!`)`([\w:]+(?:\(\))?)`(?!`)", link, part)
                   for k, part in enumerate(parts))


def table_of_names():
    """The names of each function in the four languages, as install.names compares them."""
    script = ROOT / "tests" / "install" / "names.py"
    table = subprocess.run([sys.executable, script, ROOT, "--table"], check=True, text=True,
                           capture_output=True)
    return f"# Names in all languages\n\n{table.stdout}"


def gather(folder):
    for name in ["README", *(page for pages in MENU.values() for page in pages)]:
        source = ROOT / f"{name}.md"
        if name.startswith("reference/"):
            continue
        target = folder / f"{name}.md"
        target.parent.mkdir(parents=True, exist_ok=True)
        text = without_sources(source.read_text())
        if name != "CHANGELOG":
            text = linked_names(text, reference.links_of_types(ROOT, Path(name).parent))
        target.write_text(text + menu() if name == "README" else text)
        for picture in pictures_of(text):
            place = target.parent / picture
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source.parent / picture, place)
    for name, text in {**reference.pages(ROOT), "reference/names.md": table_of_names()}.items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    for file in (ROOT / "docs" / "conf.py", ROOT / "CITATION.cff"):
        shutil.copy(file, folder)
    for name in ("site.css", "site.js"):
        shutil.copy(ROOT / "docs" / name, folder)


def without_place():
    """Headers for users that the reference lacks."""
    named = {f"{name}.hpp" for name in reference.CPP} | {f"{name}.h" for name in reference.C}
    include = ROOT / "include" / "rrcb"
    for path in include.rglob("*.h*"):
        name = str(path.relative_to(include))
        if not name.startswith("detail/") and name not in (*named, "export.h") and "RRCB_API " in path.read_text():
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
