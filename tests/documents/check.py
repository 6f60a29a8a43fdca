#!/usr/bin/env python3
"""check.py FOLDER: checks what the documents of a source tree refer to.

Fails unless every relative link leads to a file, and its mark to a heading; every path in the type of
code is there; each message in the table of docs/errors.md is in the source, except words in capitals,
which stand for numbers and names; every figure is shown, with a caption and a command; and the comment
of each public function has at most 15 lines and all parameters, if there are several.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs"))
sys.dont_write_bytecode = True

from reference import faulty_comments  # noqa: E402

# What stands for names in messages.
PLACE = re.compile(r"\b(?:[A-Z]|[A-Z]{4,})\b")
FOLDERS = ("cmake", "comparisons", "docs", "examples", "include", "packaging", "python", "src",
           "tests", "tools")
# Made by a run.
MADE = ("comparisons/out", "examples/mpm/out")


def documents(root):
    """Those that git lists or, without git or in a copy, all but what runs have made."""
    if shutil.which("git"):
        listed = subprocess.run(["git", "-C", str(root), "ls-files", "--cached", "--others",
                                 "--exclude-standard", "*.md"], capture_output=True, text=True)
        names = listed.stdout.split()
        if names:
            return [root / name for name in names]
    names = [str(path.relative_to(root)) for path in root.rglob("*.md")]
    return [root / name for name in names if not name.startswith(("build/", *MADE))]


def marks_of(document):
    headings = re.findall(r"^#+ (.*)$", document.read_text(), re.M)
    return {re.sub(r"[^\w -]", "", heading.lower()).strip().replace(" ", "-")
            for heading in headings}


def broken_links(document):
    for target in re.findall(r"\]\(([^)\s]+)\)", document.read_text()):
        if re.match(r"\w+:", target):
            continue
        path, _, mark = target.partition("#")
        file = (document.parent / path) if path else document
        if not file.exists() or (mark and mark not in marks_of(file)):
            yield f"{document}: no {target}"


def missing_paths(document, root):
    text = re.sub(r"```.*?```", "", document.read_text(), flags=re.S)
    for path in re.findall(rf"`((?:{'|'.join(FOLDERS)})/[\w./-]+)", text):
        if path.startswith(MADE):
            continue
        folders = (root, document.parent)
        if not any((folder / path.rstrip(".")).exists() for folder in folders):
            yield f"{document}: no {path}"


def source_text(root):
    """All texts of the source, where lines that follow each other are one."""
    files = [path for path in (root / "src").rglob("*.[ch]pp")]
    text = " ".join(path.read_text() for path in files)
    return re.sub(r'"\s*"', "", text).replace('\\"', '"')


def unknown_messages(root):
    source = source_text(root)
    rows = re.findall(r"^\| `(.*?)` \|", (root / "docs" / "errors.md").read_text(), re.M)
    if not rows:
        yield "docs/errors.md has no messages"
    for row in rows:
        for piece in PLACE.split(row.replace("MPI_COMM_NULL", "\0")):
            piece = piece.replace("\0", "MPI_COMM_NULL").strip(' "0')
            if len(piece) > 3 and piece not in source:
                yield f'docs/errors.md: no message has "{piece}"'


def problems_of_figures(root, found):
    """Figures of docs need a caption, and a command in CONTRIBUTING.md that draws them."""
    commands = (root / "CONTRIBUTING.md").read_text()
    texts = {document: document.read_text() for document in found}
    for figure in sorted((root / "docs" / "figures").iterdir()):
        shown = rf"!\[[^\]]*\]\([\w./]*{re.escape(figure.name)}\)"
        shows = [text for text in texts.values() if re.search(shown, text)]
        stem = re.escape(figure.stem.split("_figure_")[0].split("_cycle_")[0])
        if not shows:
            yield f"{figure}: no document shows it"
        elif not all(re.search(shown + r"\n\n\*\w", text) for text in shows):
            yield f"{figure}: no caption follows it"
        if not re.search(rf"{stem}(_\*)?\.\w+", commands):
            yield f"{figure}: CONTRIBUTING.md has no command that draws it"


def main():
    root = Path(sys.argv[1])
    found = documents(root)
    problems = [problem for document in found
                for problem in (*broken_links(document), *missing_paths(document, root))]
    problems += [*unknown_messages(root), *problems_of_figures(root, found), *faulty_comments(root)]
    print("\n".join(problems) or f"{len(found)} documents")
    return 1 if problems or not found else 0


if __name__ == "__main__":
    sys.exit(main())
