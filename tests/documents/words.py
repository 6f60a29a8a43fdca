#!/usr/bin/env python3
"""words.py FOLDER: checks the language of a source tree.

Fails if documents, or the comments of include and src, have more of the words in LIMITS than stated
for 1,000 words, or too many sentences above 30 words; and if a document is longer than its budget. The
documents of examples/mpm have budgets, but are not part of the sum.
"""
import re
import sys
from pathlib import Path

from check import documents

# For 1,000 words: twice as many as the headers of ArborX have.
LIMITS = {"where": 2.6, "what": 0.8, "tell|tells|told": 0.5}
LONGEST = 30
LONG_SHARE = 0.03
# Words as `wc -w` counts them. Others may have 250; all but examples/mpm together TOTAL.
TOTAL = 17750
BUDGETS = {
    "README.md": 890, "CHANGELOG.md": 408, "CONTRIBUTING.md": 480, "comparisons/README.md": 710,
    "comparisons/columns.md": 950, "docs/choosing.md": 1130, "docs/hard_cases.md": 440,
    "docs/errors.md": 940, "docs/first_program.md": 395, "docs/hosts.md": 640,
    "docs/install.md": 640, "docs/kokkos.md": 970, "docs/loop.md": 610, "docs/machines.md": 490,
    "docs/parameters.md": 930, "docs/performance.md": 730, "docs/python.md": 436,
    "docs/rebalancing.md": 400,
    "docs/weights.md": 700, "docs/zoltan.md": 1115, "docs/design/how_it_works.md": 900,
    "docs/design/many_ranks.md": 500, "docs/design/paper.md": 870,
    "docs/design/rebalancing.md": 410, "docs/design/statistical_domain.md": 730,
    "docs/design/testing.md": 540, "examples/mpm/README.md": 1000,
    "examples/mpm/docs/energy.md": 500, "examples/mpm/docs/method.md": 600,
    "examples/mpm/docs/parallel.md": 450, "examples/mpm/docs/scene_files.md": 700,
}


def prose_of(document):
    """Paragraphs, items and cells of a document, without code."""
    text = re.sub(r"```.*?```|^    .*$|^\|[-|: ]+\|$", "", document, flags=re.S | re.M)
    text = re.sub(r"^( *[-*]|#+|\d+\.|\|) ", "\n\n", text, flags=re.M)
    text = re.sub(r"\]\([^)]*\)|[\[\]*`]", "", text)
    return re.split(r"\n\s*\n| \|", text)


def comments_of(source):
    """Paragraphs of the comments of a file in C or C++, without examples."""
    lines = [re.sub(r"^\s*(///?<?|/\*\*|\*/?) ?|\*/\s*$", "", line)
             if re.match(r"\s*(//|/\*\*|\*)", line) else
             "".join(re.findall(r"(?://|/\*\*)[/<!]* (.*)", line)) for line in source.splitlines()]
    text = "\n".join(re.sub(r"^    .*|NOLINT.*|clang-format o.*", "", line) for line in lines)
    return re.split(r"\n\s*\n|@param", text)


def sentences_of(paragraphs):
    for paragraph in paragraphs:
        for sentence in re.split(r"(?<=[.!?:])\s+", paragraph.strip()):
            words = [word for word in sentence.split() if re.search(r"\w", word)]
            if words:
                yield words


def problems_of(name, sentences):
    """What is above its limit, with the sentences that cause it."""
    num_words = sum(map(len, sentences))
    for idiom, limit in LIMITS.items():
        found = [words for words in sentences for word in words
                 if re.fullmatch(rf"({idiom})\W*", word.lower())]
        rate = 1000 * len(found) / max(num_words, 1)
        if rate > limit:
            yield f"{name}: {rate:.2f} of {idiom} in 1,000 words, at most {limit}:"
            yield from ("    " + " ".join(words) for words in found[:10])
    long = [words for words in sentences if len(words) > LONGEST]
    share = len(long) / max(len(sentences), 1)
    if share > LONG_SHARE:
        yield f"{name}: {share:.1%} of the sentences have more than {LONGEST} words:"
        yield from (f"    {len(words)}: " + " ".join(words)
                    for words in sorted(long, key=len, reverse=True)[:20])


def beyond_budget(texts):
    sizes = {name: len(text.split()) for name, text in texts.items()}
    for name, size in sizes.items():
        budget = BUDGETS.get(name, 250)
        if size > budget:
            yield f"{name}: {size} words, at most {budget}; delete, or raise it in {__file__}"
    total = sum(size for name, size in sizes.items() if not name.startswith("examples/mpm/"))
    if total > TOTAL:
        yield f"{total} words in all documents, at most {TOTAL}"


def main():
    root = Path(sys.argv[1])
    texts = {str(path.relative_to(root)): path.read_text() for path in documents(root)}
    sources = [path for folder in ("include", "src") for path in (root / folder).rglob("*")
               if path.suffix in (".h", ".hpp", ".cpp")]
    groups = {
        "documents": [prose_of(text) for text in texts.values()],
        "comments of include": [comments_of(path.read_text()) for path in sources
                                if "include" in path.relative_to(root).parts[0]],
        "comments of src": [comments_of(path.read_text()) for path in sources
                            if "src" in path.relative_to(root).parts[0]],
    }
    found, counts = [], []
    for name, files in groups.items():
        sentences = [words for paragraphs in files for words in sentences_of(paragraphs)]
        long = sum(len(words) > LONGEST for words in sentences)
        counts.append(f"{name}: {sum(map(len, sentences))} words, {long} of {len(sentences)} "
                      f"sentences above {LONGEST}")
        found += problems_of(name, sentences)
    found += beyond_budget(texts)
    print("\n".join(found or counts))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
