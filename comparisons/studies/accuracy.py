"""What accuracy costs: every method with a grid of its parameters on each cloud."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pandas as pd
import plot
from choice import EVERYWHERE, automatic_sentence, choices, judgements
from cost import draw_sweep_time
from document import Document
from driver import Driver
from results import cases, measurements, read, write_csv
from tables import choice_matrix, choice_table

CLOUDS = "clouds"
SHAPES = ("slope", "clusters", "lattice", "uniform")


def settings() -> list[str]:
    """RRCB with each mesh and tolerance, the paper's method with three meshes, and the others."""
    found = ["zoltan-rcb", "zoltan-rib", "zoltan-hsfc", "root-rcb", "rrcb-arrays"]
    found += [
        f"rrcb-sampled[mesh={mesh},k=1.5,fraction={fraction}]"
        for mesh, fraction in product((4, 10, 32), (1, 0.125))
    ]
    for mesh in ("", "mesh=2", "mesh=4", "mesh=8", "mesh=16", "mesh=32"):
        for refinement in ("refine=none", "tol=1.1", "tol=1.05", "", "tol=1.001"):
            inside = ",".join(filter(None, (mesh, refinement)))
            found.append(f"rrcb[{inside}]" if inside else "rrcb")
        found.append(f"rrcb-exact[{mesh}]" if mesh else "rrcb-exact")
    return found


def measure_clouds(driver: Driver) -> None:
    """In 2-D and 3-D, sorted and scattered over 4 ranks; all rows into sweep.csv."""
    shapes = product(SHAPES, (2, 3), ("sorted", "scattered"))
    methods, size = settings(), ["--points=200000", "--repeats=6"]
    if driver.quick:
        shapes, methods, size = [("slope", 2, "sorted")], ["zoltan-rcb", "rrcb"], []
    rows = [
        read(
            driver.run(f"{shape}-{dimension}-{layout}", 4, methods, f"--cloud={shape}",
                       f"--dim={dimension}", f"--layout={layout}", "--no-data", *size)
            / "table.csv"
        )
        for shape, dimension, layout in shapes
    ]  # fmt: skip
    pd.concat(rows).to_csv(driver.out / "sweep.csv", index=False)


def add_accuracy(document: Document, out: Path) -> None:
    """Which setting for which tolerance, and whether RRCB's own is as good."""
    clouds = measurements(read(out / "sweep.csv"))
    if clouds.empty:
        return
    chosen, judged = choices(clouds), judgements(clouds)
    write_csv(out / "automatic.csv", (judgement.numbers for judgement in judged))
    write_csv(out / "choices.csv", (choice.numbers for choice in chosen))
    plot.save(draw_sweep_time(clouds), out / "sweep_time.png")
    document.heading("Which setting for which tolerance")
    everywhere = [choice for choice in chosen if choice.case == EVERYWHERE]
    caption = "Within the tolerance on every cloud, fastest in the mean"
    document.summarise(caption, choice_table(everywhere))
    document.picture("sweep_time.png", draw_sweep_time.__doc__)
    on_each = [choice for choice in chosen if choice.case in cases(clouds)]
    table = choice_matrix if everywhere else choice_table
    document.table("Fastest within the tolerance, cloud by cloud", table(on_each))
    if judged:
        document.heading("Is the automatic choice a good one?")
        document.paragraph(automatic_sentence(judged))
        document.table("RRCB's own mesh beside the best one tried", [j.texts for j in judged])
