"""What effects cost, by instructions of a step with them over those of one without.

costs.py PROGRAMS SCENES

PROGRAMS is the folder of mpm_with_all, SCENES that of the scene files.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import compare

compare.STEPS = 10

FAR_PLANE = """  planes:
    far:
      point: [0, -1000]
      normal: [0, 1]
      kind: frictional
      friction: 0.1
"""


def without(text: str, effect: str) -> str:
    """The scene without an effect, whose parameters are indented by six."""
    before, after = text.split(f"    {effect}:", 1)
    lines = after.splitlines(keepends=True)[1:]
    while lines and lines[0].startswith("      "):
        del lines[0]
    return before + "".join(lines)


# Scene, what is counted, changes of the scene without and with it, and the largest quotient.
COSTS = (
    ("slope", "locking_cure", lambda text: without(text, "locking_cure"), str, 1.1),
    ("slope", "a far plane", str, lambda text: text + FAR_PLANE, 1.12),
)


def instructions(program: Path, name: str, text: str, folder: Path, known: dict) -> float:
    """Those of a point, each scene run once."""
    if text not in known:
        scene = folder / f"{name}.yaml"
        scene.write_text(text)
        result = compare.run(program, scene, True)
        known[text] = result.instructions / result.points
    return known[text]


def main(programs: Path, scenes: Path) -> int:
    failed, known = 0, {}
    print("| scene | effect | instructions with it by those without | at most |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, effect, bare, full, most in COSTS:
            text = (scenes / f"{name}.yaml").read_text()
            less, more = (
                instructions(programs / "mpm_with_all", name, change(text), Path(folder), known)
                for change in (bare, full)
            )
            print(f"| {name} | {effect} | {more / less:.3f} | {most} |", flush=True)
            failed += more > most * less
    return failed


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("costs.py PROGRAMS SCENES")
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
