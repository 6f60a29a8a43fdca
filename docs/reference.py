"""Makes the reference of the site from the headers and the Fortran modules.

pages(root) returns the text of each page, in Markdown, by its name; it raises ValueError for a
declaration without a comment. A page has a heading for each function, class and type, with its
comment and its declaration.
"""
import functools
import os
import re
from pathlib import Path

import reference_members
import reference_python

CPP = ("points", "options", "tree_shape", "balance", "cuts", "plan", "transfer", "ghosts", "neighbours",
       "groups", "remap", "quality", "part_sizes", "controller", "restart", "error", "version", "paper",
       "teuchos/parameters", "teuchos/zoltan_parameters", "experimental/cost", "experimental/join_keys",
       "experimental/verify", "experimental/kokkos")
C = ("rrcb", "c/points", "c/balancer", "c/plan", "c/ghosts", "c/neighbours", "c/groups", "c/controller",
     "c/quality", "zoltan/rrcb_zoltan", "zoltan/optional_functions", "experimental/cost", "experimental/join_keys")
FORTRAN = ("rrcb.f90", "types.f90", "balancers.F90", "ghosts.f90", "arrays.F90", "neighbours.f90", "groups.f90",
           "controllers.F90", "functions.f90", "experimental.F90")
# What a header is for, in the lists of headers.
TASKS = {"points": "describe points", "kokkos": "divide on a device", "options": "choose", "balance": "divide",
         "cuts": "look up", "plan": "plan a move", "transfer": "move columns", "balancer": "divide, look up, move",
         "balancers": "divide, look up, move", "ghosts": "find neighbours and answer queries",
         "neighbours": "exchange in each step", "arrays": "hold arrays that grow", "groups": "keep points together", "remap": "keep numbers of parts", "quality": "measure", "part_sizes": "even out loads",
         "controller": "decide when to rebalance", "controllers": "decide when to rebalance",
         "cost": "learn weights", "restart": "save and load", "error": "handle errors", "paper": "compare"}


def comment_text(lines):
    """The text of comment lines, without their marks."""
    text = "\n".join(re.sub(r"^\s*(///?<?|!>|/\*\*|\*(?!\*)/?)( ?| \*/)", "", line)
                     for line in lines)
    return re.sub(r"\s*\*/\s*$", "", text).replace("@file\n", "")


def linked(text, links):
    """Names in the text that have a heading lead there; lines of code stay."""
    def link(found):
        target = links.get(next(filter(None, found.groups())))
        return f"[{found[0]}]({target})" if target else found[0]
    names = r"(?<![`\w:(/])(?:rrcb::(\w+)(?:::\w+)?(?:\(\))?|(\w+)\(\)|([A-Z]\w+)::\w+)"
    return "\n".join(line if line.startswith("    ") else re.sub(names, link, line)
                     for line in text.split("\n"))


def as_markdown(comment):
    """A comment as Markdown: parameters are a list."""
    text = re.sub(r"^@param (\w+)", r"- `\1`:", comment, flags=re.M)
    text = re.sub(r"^@return ", "\nReturns ", text, flags=re.M)
    text = re.sub(r"([^\n])\n(- `\w+`:)", r"\1\n\n\2", text, count=1)
    text = re.sub(r"^Throws ", "\nThrows ", text, flags=re.M)
    return re.sub(r"<(?=\w)", r"\\<", text).strip()


def without_bodies(code):
    """A declaration with `;` in place of each body of a function, initializers included."""
    result, depth, at = "", 0, 0
    while at < len(code):
        brace = re.match(r"(\s*:\s[^;{]*)?\s*\{", code[at:])
        before = re.sub(r"///.*|//.*", "", result).rstrip()
        if brace and depth <= 1 and re.search(r"\)( const| noexcept| override)*$", before):
            end = at + brace.end()
            level = 1
            while level:
                level += {"{": 1, "}": -1}.get(code[end], 0)
                end += 1
            result, at = result.rstrip() + ";", end
            continue
        depth += {"{": 1, "}": -1}.get(code[at], 0)
        result += code[at]
        at += 1
    return result


def statement_end(lines, first):
    """The line behind the statement that begins at `first`."""
    depth, at = 0, first
    while at < len(lines):
        code = re.sub(r"//.*|/\*.*?\*/", "", lines[at])
        depth += sum({"{": 1, "}": -1, "(": 1, ")": -1}.get(letter, 0) for letter in code)
        at += 1
        if depth == 0 and re.search(r"[;}]\s*$", code):
            break
    return at


def without_template(code):
    """A declaration without its templates and their conditions."""
    code = code.lstrip()
    while code.startswith("template"):
        depth, at = 1, code.index("<") + 1
        while depth:
            depth += {"<": 1, ">": -1}.get(code[at], 0)
            at += 1
        code = code[at:].lstrip()
    return re.sub(r"^requires\s*\(.*?\) ", "", code)


def name_of(code):
    """The name that a declaration declares."""
    code = re.sub(r"///<.*|/\*\*<.*|RRCB_API ", "", without_template(code))
    patterns = (r"^(?:typedef )?(?:class|struct|enum(?: class)?)\s+(\w+)",
                r"^using (\w+)", r"^[^(]*?\b(?!operator)(\w+)\s*=",
                r"(operator\W+?|~?\w+)\(", r"(\w+)(?:\{|;)")
    for pattern in patterns:
        found = re.search(pattern, code)
        if found:
            return found[1]
    raise ValueError(f"no name in {code}")


def parameters_of(code):
    """The names of a function's parameters."""
    code = re.sub(r"//.*", "", without_template(code)).strip()
    found = re.search(r"\((.*)\)[^()]*$", code, re.S)
    if not found or re.match(r"struct|enum|typedef|using|class|inline constexpr", code):
        return []
    depth, parts = 0, [""]
    for letter in found[1]:
        depth += {"(": 1, "<": 1, "{": 1, ")": -1, ">": -1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    named = (re.search(r"\w+$", re.sub(r"\s*=.*", "", part, flags=re.S)) for part in parts)
    return [name[0] for name in named if name]


def trailing_comment(code):
    return re.search(r"///<|/\*\*<", code)


def items_of(lines, where):
    """Name, comment and declaration of each declaration; those of a class follow it."""
    comment, at = [], 0
    while at < len(lines):
        line = lines[at]
        bare = line.strip()
        if re.match(r"namespace (rrcb::)?detail", bare):
            while not re.match(r"\}\s*// namespace (rrcb::)?detail", lines[at].strip()):
                at += 1
            at += 1
        elif bare == "private:":
            return
        elif re.match(r"///(?!<)", bare):
            comment.append(line)
            at += 1
        elif bare.startswith("/**"):
            while True:
                comment.append(lines[at])
                at += 1
                if "*/" in comment[-1]:
                    break
            if "@file" in "".join(comment):
                yield "", comment_text(comment), ""
                comment = []
        elif (not bare or bare.startswith(("#", "//", "/*", "*", "}", "friend", "extern \"C\""))
              or re.match(r"namespace|(class|struct) \w+;|public:|\w+\(const \w+&\) = delete", bare)):
            while lines[at].endswith("\\"):
                at += 1
            comment = comment if bare.startswith("#") else []
            at += 1
        else:
            end = statement_end(lines, at)
            code = "\n".join(lines[at:end])
            if not comment and not trailing_comment(code) and not re.search(r"= delete|override;", code):
                raise ValueError(f"{where}: no comment at {bare}")
            declares = re.match(r"class (?:RRCB_API )?(\w+)", bare)
            if declares:
                yield declares[1], comment_text(comment), ""
                for name, text, inner in items_of(lines[at + 1:end - 1], where):
                    yield f"{declares[1]}::{name}", text, inner
            else:
                code = without_bodies(code)
                yield name_of(code), comment_text(comment), code
            comment, at = [], end


def page(title, language, items, links):
    """Items of one name that follow each other share a heading."""
    parts, latest = [f"# {title}"], None
    for name, comment, code in items:
        if name and name != latest:
            parts.append(f"## {name}")
        latest = name
        indent = len(code) - len(code.lstrip())
        code = "\n".join(line[indent:] if not line[:indent].strip() else line
                         for line in code.splitlines()).replace("RRCB_API ", "")
        code, members = reference_members.split(code)
        if code:
            parts.append(f"```{language}\n{code}\n```")
        parts.append(as_markdown(linked(comment, links)))
        parts.append("\n".join((f"- `{member}`: " if member else "") + as_markdown(linked(text, links))
                               for member, text in members))
    return "\n\n".join(part for part in parts if part) + "\n"


def fortran_items(text, public):
    """Public types, with their bound procedures, and public procedures of a module."""
    head = re.search(r"^((?:!>.*\n)+)module", text, re.M)
    yield "", comment_text(head[1].splitlines()) if head else "", ""
    bindings = re.findall(r"^    (?:procedure|generic) :: (?:(\w+) => )?(\w+) *(?:!< (.*))?$", text,
                          re.M)
    bound_names = {inner: outer or inner for outer, inner, _ in bindings}
    kinds = r"(type|interface|(?:pure )?subroutine|(?:pure )?function)\b([^\n]*)"
    for found in re.finditer(rf"((?:^  !>[^\n]*\n)*)^  {kinds}\n(.*?)"
                             r"^  end (?:type|interface|subroutine|function)\b", text, re.M | re.S):
        comment, kind, rest, body = found.groups()
        name = re.search(r"(\w+)", rest.split("::")[-1])[1]
        bound = re.match(r"\s*class\((rrcb_\w+)\)", body)
        if bound and name in bound_names:
            title = f"{bound[1]}%{bound_names[name]}"
        elif name in public and not bound:
            title = name
        else:
            continue
        if not comment:
            raise ValueError(f"Fortran: no comment at {name}")
        code = f"  {kind}{rest}\n{body}  end {kind}"
        if kind not in ("type", "interface"):
            declared = [line for line in body.splitlines()
                        if re.search(rf"::.*\b({'|'.join(re.findall('[a-z_]+', rest))})\b", line)]
            code = "\n".join([f"  {kind}{rest}", *declared])
        yield title, comment_text(comment.splitlines()), code


def public_names(sources):
    """The names that the modules rrcb and rrcb_experimental export."""
    text = re.sub(r"&\s*\n", "", (sources / "rrcb.f90").read_text())
    names = re.findall(r"\brrcb_\w+", " ".join(re.findall(r"only:(.*)", text)))
    return {*names, *re.findall(r"public :: (rrcb_\w+)", (sources / "experimental.F90").read_text())}


def faults(file, name, comment, parameters):
    """Whether the comment of a function is above 15 lines or lacks some of several parameters."""
    if len(comment.splitlines()) > 15:
        yield f"{file}: the comment of {name} has more than 15 lines"
    for each in parameters if len(parameters) > 1 else []:
        if not re.search(rf"^@param {each}\b", comment, re.M):
            yield f"{file}: {name} has no @param {each}"


def faulty_comments(root):
    """Faults of the headers and of the Fortran modules."""
    for name in (*(f"{each}.hpp" for each in CPP), *(f"{each}.h" for each in C)):
        file = Path(root) / "include" / "rrcb" / name
        for function, comment, code in items_of(file.read_text().splitlines(), name):
            yield from faults(file, function, comment, parameters_of(code) if code else [])
    sources = Path(root) / "src" / "fortran"
    for name in FORTRAN:
        file = sources / name
        for function, comment, code in fortran_items(file.read_text(), public_names(sources)):
            listed = re.match(r" *(?:pure )?(?:subroutine|function) \w+\(([\w, ]*)\)", code)
            given = listed[1].split(", ") if listed else []
            yield from faults(file, function, comment, [each for each in given if each not in ("self", "error")])


def mark_of(name):
    """The mark of a heading, as Sphinx makes it."""
    return re.sub(r"[^\w -]", "", name.lower())


def overview(title, text, names, all_items):
    lines = [f"# {title}", "", text, ""]
    for name in names:
        found = [item[0] for item in all_items[name] if item[0] and "::" not in item[0]]
        listed = ", ".join(f"[`{each}`]({name}.md#{mark_of(each)})" for each in dict.fromkeys(found))
        task = TASKS.get(re.sub(r".*/|\.\w+$", "", name))
        lines.append(f"- {task + ', ' if task else ''}[{name}]({name}.md): {listed}")
    links = "\n".join(f"{name}.md" for name in names)
    return "\n".join(lines) + f"\n\n```{{toctree}}\n:hidden:\n\n{links}\n```\n"


def links_from(folder, items):
    """The address of the heading of each name in C and C++, from a page in `folder`."""
    found = {}
    for title, of_page in items.items():
        if title.endswith("pp"):
            for name, _, _ in of_page:
                place = os.path.relpath(f"{title}.md", folder)
                found.setdefault(name.split("::")[-1] if name else "", f"{place}#{mark_of(name)}")
    return found


@functools.cache
def links_of_types(root, folder):
    """The address of each function and type of C++, from a page in `folder`; not of members."""
    found = {}
    for name in CPP:
        text = (Path(root) / "include" / "rrcb" / f"{name}.hpp").read_text()
        place = os.path.relpath(f"reference/rrcb/{name}.hpp.md", folder)
        for title, _, _ in items_of(text.splitlines(), name):
            if title and "::" not in title:
                found.setdefault(title, f"{place}#{mark_of(title)}")
    return found


def pages(root):
    include = Path(root) / "include" / "rrcb"
    sources = Path(root) / "src" / "fortran"
    items, languages = {}, {}
    for names, suffix, language in ((CPP, ".hpp", "cpp"), (C, ".h", "c")):
        for name in names:
            title = f"rrcb/{name}{suffix}"
            text = (include / f"{name}{suffix}").read_text()
            items[title] = list(items_of(text.splitlines(), title))
            languages[title] = language
    for name in FORTRAN:
        title = f"fortran/{name}"
        items[title] = list(fortran_items((sources / name).read_text(),
                                         public_names(sources)))
        languages[title] = "fortran"
    result = {f"reference/{title}.md": page(title, languages[title], of_page,
                                            links_from(os.path.dirname(title), items))
              for title, of_page in items.items()}
    for language, heading, text in (
            ("cpp", "C++", "Include `rrcb/rrcb.hpp`, which has all but the last eight headers."),
            ("c", "C", "Include `rrcb/rrcb.h`."), ("fortran", "Fortran", "The module is `rrcb`.")):
        titles = [title for title in items if languages[title] == language]
        result[f"reference/{language}.md"] = overview(heading, text, titles, items)
    result["reference/python.md"] = reference_python.page(root)
    return result
