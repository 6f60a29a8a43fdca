#!/usr/bin/env python3
"""site.py FOLDER: checks the links of a site in HTML.

Fails unless each link, picture and script of each page leads to a file of the site, and its mark to a
mark there, and no link is left as text. Links to other sites are only counted.
"""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote


class Page(HTMLParser):
    """What a page refers to, and the marks it has."""

    def __init__(self, path):
        super().__init__()
        self.links, self.marks, self.texts = [], set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name == "id" or (name == "name" and tag == "a"):
                self.marks.add(value)

    def handle_data(self, data):
        self.texts += re.findall(r"@ref \S+.*", data)


def links_of_menu(folder):
    """The menus and the tree of pages are written by scripts."""
    for script in ("menudata.js", "navtreedata.js"):
        path = folder / script
        if path.exists():
            yield from re.findall(r'"([^"\s]+\.html(?:#\w+)?)"', path.read_text())


def broken(folder, page, link, pages):
    target, _, mark = unquote(link).partition("#")
    file = (page.parent / target).resolve() if target else page
    if not file.is_file() or folder not in file.parents:
        return True
    return bool(mark) and file in pages and mark not in pages[file].marks


def main():
    folder = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in folder.rglob("*.html")}
    found = [(page, link) for page in pages for link in pages[page].links]
    found += [(folder / "index.html", link) for link in links_of_menu(folder)]
    inside = [(page, link) for page, link in found if not re.match(r"\w+:|//", link)]
    problems = sorted({f"{page.name}: {link} leads nowhere" for page, link in inside
                       if broken(folder, page, link, pages)})
    problems += [f"{page.name}: {text} is no link" for page in pages for text in pages[page].texts]
    print("\n".join(problems) or f"{len(pages)} pages, {len(inside)} links within the site, "
          f"{len(found) - len(inside)} to others")
    return 1 if problems or not inside else 0


if __name__ == "__main__":
    sys.exit(main())
