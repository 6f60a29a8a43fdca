"""Splits the declaration of a struct or an enumeration into its code and a list of its members."""
import re


def one_line_comments(code):
    """Comments of C as those of C++, on one line each."""
    def joined(found):
        mark = "///<" if found[1] else "///"
        return f"{mark} " + " ".join(re.sub(r"^\s*\*", "", line).strip()
                                     for line in found[2].splitlines())
    return re.sub(r"/\*\*(<?)(.*?)\*/", joined, code, flags=re.S)


def split(code):
    """Code without comments, and (declaration, comment) of each member, or ("", comment) of what has
    none; no members if they nest."""
    lines = one_line_comments(code).splitlines()
    if not re.match(r"\s*(template <[^{]*> *)?(typedef )?(struct|enum)\b[^;]*\{", code):
        found = [line.partition("///<") for line in lines]
        bare = "\n".join(line.rstrip() for line, _, _ in found if line.strip())
        comment = " ".join(text.strip() for _, mark, text in found if mark)
        return (bare, [("", comment)]) if comment else (code, [])
    first = next(k for k, line in enumerate(lines) if line.split("//")[0].rstrip().endswith("{"))
    body = lines[first + 1:-1]
    if any(line.split("//")[0].rstrip().endswith("{") for line in body):
        return code, []
    members, before, statement, after = [], [], "", ""
    bare = [line.split("//")[0].rstrip() for line in lines[:first + 1]]
    for line in body:
        text, mark, comment = line.partition("///")
        if text.strip():
            bare.append(text.rstrip())
        if mark and not text.strip() and not comment.startswith("<"):
            before.append(comment.strip())
            continue
        comment = comment.removeprefix("<").strip()
        if not text.strip():
            if members and comment:
                members[-1][1] += f" {comment}"
            continue
        statement, after = f"{statement} {text.strip()}".strip(), f"{after} {comment}".strip()
        if re.search(r"[;,]$", statement) or line is body[-1]:
            members.append([statement.rstrip(";,"), " ".join([*before, after]).strip()])
            before, statement, after = [], "", ""
    bare.append(lines[-1])
    return "\n".join(bare), [tuple(each) for each in members if each[1]]
