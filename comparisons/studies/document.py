"""A document of headings, text, tables and pictures, written as HTML and as Markdown."""

from __future__ import annotations

import base64
import html
import re
from dataclasses import dataclass, field
from pathlib import Path

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #222; margin: 0 auto; max-width: 72rem;
  padding: 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { font-size: 1.3rem; margin-top: 2.2rem; }
.conclusion { border-left: 4px solid #0072B2; background: #F2F7FB; padding: .1rem 1rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; }
.caption { font-size: .9rem; font-weight: 600; margin: 1.6rem 0 .3rem; }
th, td { padding: .25rem .6rem; text-align: right; white-space: nowrap;
  border-bottom: 1px solid #DDD; }
.text { white-space: normal; }
th:first-child, td:first-child, .text { text-align: left; }
th, td:first-child { white-space: nowrap; }
summary { cursor: pointer; }
figure { margin: 1.5rem 0; } figcaption { font-size: .9rem; color: #444; }
img { display: block; width: 100%; height: auto; }
pre { font-size: .78rem; background: #F6F6F6; padding: .8rem; overflow-x: auto; }
"""


LONGEST = 80  # rows of a table that is not folded up
Rows = list[dict[str, str]]  # of a table: texts by the names of its columns, the same in every row


@dataclass
class Document:
    title: str
    folder: Path
    blocks: list[tuple] = field(default_factory=list)
    summary: str = ""  # what is worth printing

    def conclude(self, texts: list[str]) -> None:
        self.blocks.append(("conclusion", texts))
        self.summary += "\n" + "\n".join(texts) + "\n"

    def heading(self, text: str) -> None:
        self.blocks.append(("heading", text))

    def paragraph(self, text: str) -> None:
        self.blocks.append(("paragraph", text))

    def listing(self, caption: str, text: str) -> None:
        self.blocks.append(("listing", caption, text))

    def picture(self, name: str, caption: str) -> None:
        """Nothing where there is no such picture."""
        if (self.folder / name).exists():
            self.blocks.append(("picture", name, caption))

    def table(self, caption: str, rows: Rows) -> None:
        """Nothing without rows; a long one is folded up."""
        if rows:
            lines = [list(rows[0]), *(list(row.values()) for row in rows)]
            self.blocks.append(("table", caption, lines))

    def summarise(self, caption: str, rows: Rows) -> None:
        """A table that is worth printing too."""
        self.table(caption, rows)
        if rows:
            self.summary += f"\n{caption}\n\n{_columns(self.blocks[-1][2])}\n"

    def write(self) -> None:
        """report.html and report.md."""
        body = "\n".join(_html_block(block, self.folder) for block in self.blocks)
        title = html.escape(self.title)
        (self.folder / "report.html").write_text(
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
            f"{body}\n</body>\n</html>\n",
            encoding="utf-8",
        )
        body = "\n\n".join(map(_markdown_block, self.blocks))
        text = f"# {self.title}\n\n{body}\n"
        (self.folder / "report.md").write_text(text, encoding="utf-8")


def _html_block(block: tuple, folder: Path) -> str:
    kind, *content = block
    if kind == "conclusion":
        return f'<div class="conclusion">{"".join(_tag("p", text) for text in content[0])}</div>'
    if kind == "picture":
        name, caption = content
        image = _html_image((folder / name).read_bytes(), caption)
        return f'<figure><div class="wide">{image}</div>{_tag("figcaption", caption)}</figure>'
    if kind == "table":
        return _html_table(*content)
    if kind == "listing":
        return _tag("p", content[0]) + _tag("pre", content[1])
    return _tag("h2" if kind == "heading" else "p", content[0])


def _html_image(png: bytes, caption: str) -> str:
    """At most as wide as its text is made for; a narrow page scrolls it."""
    width = int.from_bytes(png[16:20], "big") * 4 // 5
    data = base64.b64encode(png).decode("ascii")
    return (
        f'<img alt="{html.escape(_alternative(caption))}" style="max-width: {width}px; min-width:'
        f' min({width}px, 44rem)" src="data:image/png;base64,{data}">'
    )


def _html_table(caption: str, lines: list[list[str]]) -> str:
    rows = lines[1:]
    is_text = [2 * sum(map(_is_number, column)) < len(rows) for column in zip(*rows)]
    head, *body = (
        "<tr>" + "".join(_cell(tag, text, left) for text, left in zip(cells, is_text)) + "</tr>"
        for tag, cells in zip(["th"] + ["td"] * len(rows), lines)
    )
    text = html.escape(caption)
    body = "\n".join(body)
    table = f'<div class="wide"><table aria-label="{text}">\n<thead>{head}</thead>\n'
    table += f"<tbody>{body}</tbody></table></div>"
    # The caption stands beside the table, since in it it would be as wide and scroll with it.
    if len(rows) > LONGEST:
        summary = f'<summary class="caption">{text}, {len(rows)} rows</summary>'
        return f"<details>{summary}{table}</details>"
    return f'<p class="caption">{text}</p>\n{table}'


def _cell(tag: str, text: str, left: bool) -> str:
    return f"<{tag}{' class=text' if left else ''}>{html.escape(text)}</{tag}>"


def _is_number(text: str) -> bool:
    """Also with an interval behind it."""
    number = r"[-+±\d.,e]*\d( ?(ms|s|%|×|MiB))?"
    pattern = rf"[-–]|{number}( \[{number}, {number}\])?(, not told apart)?"
    return re.fullmatch(pattern, text) is not None


def _tag(name: str, text: str) -> str:
    return f"<{name}>{html.escape(text)}</{name}>"


def _markdown_block(block: tuple) -> str:
    kind, *content = block
    if kind == "conclusion":
        return "\n".join(f"> {text}\n>" for text in content[0]).removesuffix("\n>")
    if kind == "picture":
        return f"![{_alternative(content[1])}]({content[0]})\n\n*{content[1]}*"
    if kind == "table":
        return f"**{content[0]}**\n\n{markdown_table(content[1])}"
    if kind == "listing":
        return f"{content[0]}:\n\n```\n{content[1].rstrip()}\n```"
    return f"## {content[0]}" if kind == "heading" else content[0]


def markdown_table(lines: list[list[str]]) -> str:
    """The first line is the header."""
    cells = ([cell.replace("|", "\\|") for cell in line] for line in lines)
    header, *rows = ("| " + " | ".join(line) + " |" for line in cells)
    return "\n".join([header, "|---" * len(lines[0]) + "|", *rows])


def _alternative(caption: str) -> str:
    """The first sentence, for who does not see the picture."""
    return caption.split(". ")[0].rstrip(".")


def _columns(rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "\n".join(
        "  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip() for row in rows
    )
