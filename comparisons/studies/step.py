"""Compares the services of a step by the library and by hand: instructions, traffic and memory of each call.

Random points have positions, velocities and numbers, and 1 % of them leave their rank in each step. Ghosts are within
two spacings. Forces act on them and are added to those on their points. Every arm must give the same ghosts and the
same sums. Instructions are counted by Callgrind, without those of MPI. --clock measures seconds instead, on 2 ranks
that need a core each. The arms run in a random order in each round, and one of them runs twice.
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import callgrind
import pandas as pd
import plot
from document import CORES, markdown_table
from driver import options, prepare
from intervals import median_of
from results import printed

ARMS = ("loop", "neighbours", "by-hand")
CASES = ((2, 4), (2, 8), (3, 4), (3, 8))  # dimension, ranks
JUMPS = (8, 16)  # ranks, in 2-D
POINTS = 20_000  # of a rank
BY_CAUSE = ("loop", "ghosts")
CASE = ["dim", "ranks"]
# Upper bounds of the instructions per point and step, for stages or complete arms, which --hold checks.
BOUNDS = {
    (2, 4): {"loop ghosts": 78, "loop": 125, "by-hand": 44},
    (3, 8): {"loop ghosts": 135, "loop": 215, "by-hand": 132},
}
MOST_OF_BY_HAND = 1.2  # bound of the library's step relative to the step by hand
TIMED_RANKS, ROUNDS = 2, 10  # two turns in each round
TIMED = ("loop", "neighbours", "by-hand", "by-hand")  # the last two are the same arm
STYLES = {"assign_all": "#CC79A7", "plan": "#E69F00", "transfer, migrate": "#D55E00",
          "ghosts, find_ghosts": "#0072B2", "fetch": "#009E73", "accumulate": "#000000"}  # fmt: skip
COLOURS = {stage: colour for stages, colour in STYLES.items() for stage in stages.split(", ")}


def instructions(program: Path, dimension: int, ranks: int, points: int, steps: int, out: Path
                 ) -> dict[tuple[str, str], Counter[str]]:  # fmt: skip
    """Returns the instructions per point and step of each function, for each arm and stage."""
    words = [str(program), "instructions", str(dimension), str(points), str(steps), *ARMS]
    printed, processes = callgrind.run(words, ranks, "rrcb_step_stage", out / "callgrind")
    stages = [tuple(line.split(",")) for line in printed.splitlines()[1:]]
    found: dict[tuple[str, str], Counter[str]] = {}
    for files in processes:
        for stage, file in zip(stages, files, strict=True):
            for name, cost in callgrind.own_instructions(file).items():
                found.setdefault(stage, Counter())[name] += cost / (ranks * steps * points)
    return found


def case_name(dimension: int, ranks: int) -> str:
    return f"{dimension}-D, {ranks} ranks"


def is_moving(rows: pd.DataFrame) -> pd.Series:
    return ~rows["stage"].str.startswith("kept ")


def stage_table(rows: pd.DataFrame) -> list[list[str]]:
    """Returns the instructions per point and step of each stage, then of all stages."""
    cases = list(dict.fromkeys(zip(rows["dim"], rows["ranks"])))
    lines = [["instructions a point and step", *(case_name(*case) for case in cases)]]
    for arm, own in rows.groupby("arm", sort=False):
        by_stage = own.pivot(index="stage", columns=CASE, values="instructions").loc[own["stage"].unique()]
        for stage, row in by_stage.iterrows():
            lines.append([f"{arm}: {stage}", *(f"{row[case]:.1f}" for case in cases)])
        total = own[is_moving(own)].groupby(CASE)["instructions"].sum()
        lines.append([f"**{arm}, all**", *(f"**{total[case]:.1f}**" for case in cases)])
    return lines


def cost_table(rows: pd.DataFrame) -> list[list[str]]:
    """Returns the costs per step and rank: for steps that move points, and for steps that keep points and ghosts."""
    lines = [["case", "arm", "step", "collectives", "messages", "kB sent", "allocations", "kB allocated"]]
    for (dimension, ranks, arm), own in rows.groupby([*CASE, "arm"], sort=False):
        for name, part in (("moves", own[is_moving(own)]), ("keeps", own[~is_moving(own)])):
            total = part.sum(numeric_only=True)
            lines.append([case_name(dimension, ranks), arm, name, f"{total['collectives']:.0f}",
                          f"{total['messages']:.1f}", f"{total['bytes'] / 1000:.1f}", f"{total['allocations']:.0f}",
                          f"{total['bytes_allocated'] / 1000:.0f}"])  # fmt: skip
    return lines


def cause_table(causes: dict[tuple[int, int], Counter[str]]) -> list[list[str]]:
    """Returns the functions of `ghosts` that have at least 1 % of its instructions in some case."""
    lines = [["function", *(case_name(*case) for case in causes)]]
    everything = sum(causes.values(), Counter())
    for name, _ in everything.most_common():
        if any(of[name] >= 0.01 * of.total() for of in causes.values()):
            lines.append([f"`{callgrind.short(name)}`", *(f"{of[name]:.1f}" for of in causes.values())])
    return lines


def draw(rows: pd.DataFrame, path: Path) -> None:
    """Draws the instructions of the stages side by side, with a bar for each arm and case."""
    plot.use_style()
    cases = list(dict.fromkeys(zip(rows["dim"], rows["ranks"])))
    figure, grid = plot.panels(1, len(cases), 2.1 * len(cases), 2.6, sharey=True)
    for axes, case in zip(grid[0], cases):
        of_case = rows[is_moving(rows) & (rows[CASE] == case).all(axis=1)]
        bottoms = dict.fromkeys(of_case["arm"], 0.0)
        for row in of_case.itertuples():
            axes.bar(row.arm, row.instructions, bottom=bottoms[row.arm], color=COLOURS[row.stage])
            bottoms[row.arm] += row.instructions
        axes.set_title(case_name(*case))
    grid[0][0].set_ylabel("instructions a point")
    for stages, colour in STYLES.items():
        grid[0][0].bar(rows["arm"][0], 0, color=colour, label=stages)
    plot.legend_above(figure, grid[0][0])
    plot.save(figure, path)


def excesses(rows: pd.DataFrame) -> list[str]:
    """Returns a text for each number that exceeds its bound."""
    found = []
    for case, bounds in BOUNDS.items():
        of_case = rows[is_moving(rows) & (rows[CASE] == case).all(axis=1)]
        numbers = of_case.groupby("arm")["instructions"].sum().to_dict()
        numbers |= {f"{row.arm} {row.stage}": row.instructions for row in of_case.itertuples()}
        found += [f"{case_name(*case)}: {name} takes {numbers[name]:.1f} instructions a point, not {bound}"
                  for name, bound in bounds.items() if numbers[name] > bound]  # fmt: skip
        ratio = numbers["neighbours"] / numbers["by-hand"]
        if ratio > MOST_OF_BY_HAND:
            found.append(f"{case_name(*case)}: neighbours take {ratio:.2f} of by-hand, not {MOST_OF_BY_HAND}")
    return found


def jump_table(program: Path) -> list[list[str]]:
    """Returns the number of calls after which ranks detect a point that has passed all neighbours."""
    lines = [["far jump", "neighbours of the rank fail in call", "all ranks fail by call", "points before", "after"]]
    for ranks in JUMPS:
        found = printed(ranks, program, "jump", "2", "1000")
        if not found["is_known"].all():
            sys.exit(f"{ranks} ranks: some rank knows nothing of a point that has passed all neighbours")
        lines.append([f"{ranks} ranks", f"{found['calls'].min()}", f"{found['calls'].max()}", f"{1000 * ranks}",
                      f"{found['points'].sum()}"])  # fmt: skip
    return lines


def count_all(program: Path, out: Path, points: int, steps: int, cases=CASES) -> pd.DataFrame:
    rows, causes = pd.DataFrame(), {}
    for case in cases:
        dimension, ranks = case
        found = printed(ranks, program, "counts", *map(str, (dimension, points, steps)), *ARMS)
        found = found.assign(dim=dimension, ranks=ranks)
        if callgrind.is_here():
            of = instructions(program, *case, points, steps, out)
            found["instructions"] = [of[key].total() for key in zip(found["arm"], found["stage"])]
            causes[case] = of[BY_CAUSE]
        rows = pd.concat([rows, found], ignore_index=True)
    rows.to_csv(out / "step.csv", index=False)
    tables = [cost_table(rows)]
    if cases is CASES:
        tables.append(jump_table(program))
    if causes:
        tables = [stage_table(rows), *tables, cause_table(causes)]
        draw(rows, out / "step.png")
    write(out, tables)
    return rows


def write(out: Path, tables: list[list[list[str]]]) -> None:
    text = "\n\n".join(map(markdown_table, tables))
    (out / "table.md").write_text(text + "\n")
    print(text)


def time_all(program: Path, out: Path, points: int, steps: int, rounds: int) -> None:
    if CORES < TIMED_RANKS:
        print("The ranks share a core: times mean nothing", file=sys.stderr)
    times = pd.DataFrame()
    for number in range(rounds):
        for dimension in (2, 3):
            rows = printed(TIMED_RANKS, program, "clock", *map(str, (dimension, points, steps, number)), *TIMED)
            times = pd.concat([times, rows.assign(dim=dimension)], ignore_index=True)
            times.to_csv(out / "clock.csv", index=False)
    write(out, [time_table(times)])


def time_table(times: pd.DataFrame) -> list[list[str]]:
    """Returns the least time of a step, and medians of ratios within a turn. The last arm is the second of two equal
    ones."""
    lines = [["dimension", *(f"{arm}, least, ms" for arm in TIMED[:-1]),
              *(f"{arm} / {TIMED[-2]} [95 %]" for arm in TIMED[:-2]), "A/A [95 %]"]]  # fmt: skip
    for dimension, of_one in times.groupby("dim"):
        by_place = of_one.pivot(index="turn", columns="place", values="seconds")
        base = by_place[len(TIMED) - 2]
        ratios = [median_of(by_place[k] / base).text(2) for k in (*range(len(TIMED) - 2), len(TIMED) - 1)]
        lines.append([f"{dimension}-D", *(f"{1000 * by_place[k].min():.3f}" for k in range(len(TIMED) - 1)), *ratios])
    return lines


def main() -> None:
    parser = options("step", __doc__, "few points, two cases")
    parser.add_argument("--steps", type=int, help="default: 3, by the clock 500")
    parser.add_argument("--clock", action="store_true", help="measure seconds")
    parser.add_argument("--hold", action="store_true", help="fail if an arm takes more instructions than it may")
    given = parser.parse_args()
    program = prepare(given, "rrcb_step")
    points = 500 if given.quick else POINTS
    if given.clock:
        rounds, steps = (1, 20) if given.quick else (ROUNDS, given.steps or 500)
        time_all(program, given.out, points, steps, rounds)
        return
    rows = count_all(program, given.out, points, given.steps or 3, BOUNDS if given.quick or given.hold else CASES)
    if given.hold and (found := excesses(rows)):
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
