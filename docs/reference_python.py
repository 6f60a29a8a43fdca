"""Makes the page of the Python package from its docstrings, without importing it.

page(root) returns its text in Markdown; it raises ValueError for a public name without a docstring.
"""
import ast
import inspect
import re
from pathlib import Path


def exported(package, module):
    """The names that a module exports, and the definitions of all modules."""
    text = (package / f"{module}.py").read_text()
    names = ast.literal_eval(re.search(r"__all__ = (\[.*?\])", text, re.S)[1])
    found = {}
    for file in [package / f"{module}.py", *sorted(package.glob("_*.py"))]:
        lines = file.read_text().splitlines()
        for node in ast.parse(file.read_text()).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                found.setdefault(node.name, (node, lines))
    return names, found


def docstring(node):
    text = ast.get_docstring(node)
    if not text:
        raise ValueError(f"Python: no docstring at {node.name}")
    return inspect.cleandoc(text)


def signature(node, of_class=""):
    """The declaration of a function; of a constructor that of its class."""
    arguments = ast.unparse(node.args)
    arguments = re.sub(r"^(self|cls)(, )?", "", arguments)
    name = of_class if node.name == "__init__" else node.name
    returns = f" -> {ast.unparse(node.returns)}" if node.returns and node.name != "__init__" else ""
    return f"```python\n{name}({arguments}){returns}\n```"


def is_property(node):
    return any(isinstance(each, ast.Name) and "property" in each.id for each in node.decorator_list)


def members(node, lines):
    """Attributes as a list, then properties and methods under headings."""
    attributes = []
    for each in node.body:
        if isinstance(each, ast.AnnAssign) and not each.target.id.startswith("_"):
            comment = lines[each.lineno - 1].partition("#: ")[2]
            attributes.append(f"- `{each.target.id}: {ast.unparse(each.annotation)}`"
                              + (f": {comment}" if comment else ""))
    if attributes:
        yield "\n".join(attributes)
    for each in node.body:
        if not isinstance(each, ast.FunctionDef) or each.name.startswith("_"):
            continue
        yield f"### {node.name}.{each.name}"
        if not is_property(each):
            yield signature(each)
        yield docstring(each)


def entry(name, node, lines):
    yield f"## {name}"
    if isinstance(node, ast.FunctionDef):
        yield signature(node)
        yield docstring(node)
        return
    makes = [each for each in node.body if getattr(each, "name", "") == "__init__"]
    public = "made by" not in docstring(node)
    if makes and public:
        yield signature(makes[0], name)
    yield docstring(node)
    bases = [f"[{base.id}](#{base.id.lower()})" for base in node.bases
             if isinstance(base, ast.Name) and base.id in ("Plan", "Distribution")]
    if bases:
        yield f"Has also the members of {', '.join(bases)}."
    yield from members(node, lines)


def page(root):
    package = Path(root) / "python" / "rrcb"
    parts = ["# Functions of the Python package", "The package is `rrcb`. Without `comm` calls are over `MPI.COMM_WORLD`, and "
             "collective over `comm` if they say so."]
    for module, title in (("__init__", ""), ("experimental", "# rrcb.experimental")):
        names, found = exported(package, module)
        parts += [title, ast.get_docstring(ast.parse((package / f"{module}.py").read_text()))] * bool(title)
        for name in sorted(names, key=str.lower):
            parts += entry(name, *found[name])
    return "\n\n".join(parts) + "\n"
