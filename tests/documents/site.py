#!/usr/bin/env python3
"""site.py FOLDER: checks a site in HTML that docs/build has made.

Fails unless each link, picture and script of each page leads to a file of the site, and its mark to a
mark there; headings follow each other in order; no two pages have the same title; every function,
enumeration and type of the interface has a heading; and the index of the search has words of the
text. Links to other sites are only counted.
"""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
# Stems of words in the documents and the comments.
WORDS = ("preload", "nan", "fetch", "rcb_reus", "fortran")


class Page(HTMLParser):
    """What a page refers to, the marks it has, and its headings."""

    def __init__(self, path):
        super().__init__()
        self.links, self.marks, self.texts, self.headings = [], set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        if re.fullmatch("h[1-6]", tag):
            self.headings.append([int(tag[1]), ""])
            self.in_heading = True
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name == "id" or (name == "name" and tag == "a"):
                self.marks.add(value)

    in_heading = False

    def handle_endtag(self, tag):
        if re.fullmatch("h[1-6]", tag):
            self.in_heading = False

    def handle_data(self, data):
        self.texts += re.findall(r"\]\(\S+\.md.*", data)
        if self.in_heading:
            self.headings[-1][1] += data


def misplaced_headings(page):
    levels = [level for level, _ in page.headings]
    return levels[:1] != [1] or any(b > a + 1 for a, b in zip(levels, levels[1:]))


def repeated_titles(pages):
    """Titles that two pages have: the menu and the search would show the same text twice."""
    titles = sorted(page.headings[0][1].strip("¶#") for page in pages.values() if page.headings)
    yield from (f"two pages are titled {a}" for a, b in zip(titles, titles[1:]) if a == b)


def interface():
    """Names that the headers export, and those of the Fortran module, without classes' members."""
    headers = ROOT / "include" / "rrcb"
    for path in {*headers.rglob("*.h*")} - {*headers.glob("detail/*")}:
        text = re.sub(r"namespace (?:rrcb::)?detail \{.*?\}  // namespace (?:rrcb::)?detail", "", path.read_text(),
                      flags=re.S)
        text = re.sub(r"^(class.*?^\};)", "", re.sub(r"//.*|/\*.*?\*/", "", text, flags=re.S)
                      if path.suffix == ".h" else re.sub(r"//.*", "", text), flags=re.S | re.M)
        text = re.sub(r"^#define.*", "", text, flags=re.M)
        yield from re.findall(r"^RRCB_API[^;(]*?(\w+)\(", text, re.M)
        yield from re.findall(r"^(?:typedef )?(?:enum|enum class|struct|class) (\w+)[ :{]*\{", text, re.M)
        yield from re.findall(r"^using (\w+) =", text, re.M)
    module = re.sub(r"&\s*\n", "", (ROOT / "src/fortran/rrcb.f90").read_text())
    for listed in re.findall(r"only:(.*)", module):
        yield from (name for name in re.findall(r"rrcb_\w+", listed)
                    if not re.fullmatch(r"rrcb_(ok|\w+_(argument|memory|error)|float|double|needs_\w+)", name))


def missing_names(pages, folder):
    titles = {title.strip("¶#") for path, page in pages.items()
              if "reference" in path.relative_to(folder).parts for _, title in page.headings}
    names = set(interface())
    if len(names) < 100:
        yield f"only {len(names)} names in the interface"
    yield from (f"{name} has no heading in the reference" for name in sorted(names - titles))


def missing_words(folder):
    index = (folder / "searchindex.js").read_text()
    yield from (f"the search does not find {word}" for word in WORDS
                if not re.search(rf'[,{{"]{word}"?:', index))


def raw_comments(pages, folder):
    """Pages of the reference on which comments of members are code."""
    for path in pages:
        if "reference" in path.relative_to(folder).parts and re.search(
                r"///&lt;|/\*\*&lt;", re.sub(r"<[^>]*>", "", path.read_text())):
            yield f"{path.name}: comments of members are not text"


def missing_python(pages, folder):
    text = (ROOT / "python/rrcb/__init__.py").read_text()
    names = re.findall(r'^    "(\w+)",$', text, re.M)
    page = pages.get(folder / "reference/python.html")
    titles = {title.strip("¶#") for _, title in page.headings} if page else set()
    yield from (f"{name} has no heading in the reference of Python" for name in names
                if name not in titles)


def broken(folder, page, link, pages):
    target, _, mark = unquote(link).partition("#")
    target = target.partition("?")[0]
    file = (page.parent / target).resolve() if target else page
    if not file.is_file() or folder not in file.parents:
        return True
    return bool(mark) and file in pages and mark not in pages[file].marks


def main():
    folder = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in folder.rglob("*.html")}
    found = [(page, link) for page in pages for link in pages[page].links]
    inside = [(page, link) for page, link in found if not re.match(r"\w+:|//", link)]
    problems = sorted({f"{page.name}: {link} leads nowhere" for page, link in inside
                       if broken(folder, page, link, pages)})
    problems += [f"{path.name}: {text} is no link" for path in pages for text in pages[path].texts]
    problems += [f"{path.name}: headings are out of order" for path in pages
                 if path.name not in ("genindex.html", "search.html")
                 and misplaced_headings(pages[path])]
    without_copy = {path: page for path, page in pages.items() if path.name != "index.html"}
    problems += [*repeated_titles(without_copy), *missing_names(pages, folder), *missing_words(folder),
                 *raw_comments(pages, folder), *missing_python(pages, folder)]
    print("\n".join(problems) or f"{len(pages)} pages, {len(inside)} links within the site, "
          f"{len(found) - len(inside)} to others")
    return 1 if problems or not inside else 0


if __name__ == "__main__":
    sys.exit(main())
