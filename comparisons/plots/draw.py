"""Draws the pictures of a comparison: draw.py DIRECTORY, where the driver wrote its files.

A picture whose data is not there is left out, and removed if an earlier run drew it.
"""

from __future__ import annotations

import sys
from pathlib import Path

from cost import draw_cost
from cycle import draw_cycle
from domains import draw_domains, draw_support_mesh
from history import draw_history
from paper_figures import draw_figure_2, draw_figure_6, draw_study_history
from parts import draw_parts
from price import draw_price
from prices import write_prices
from simulation import draw_simulation
from sources import draw_sources
from speed_up import draw_ranks, draw_speed_up, write_speed_ups
from style import use_style
from sweep import draw_study, draw_sweep_bytes, draw_sweep_time

PICTURES = {
    "price.png": draw_price,
    "time_against_imbalance.png": draw_cost,
    "parts.png": draw_parts,
    "support_mesh.png": draw_support_mesh,
    "statistical_domain.png": draw_domains,
    "unbalance_history.png": draw_history,
    "simulation_time.png": draw_simulation,
    "sweep_time.png": draw_sweep_time,
    "sweep_bytes.png": draw_sweep_bytes,
    "error_sources.png": draw_sources,
    "cycle.png": draw_cycle,
    "study.png": draw_study,
    "figure_2.png": draw_figure_2,
    "speed_up.png": draw_speed_up,
    "ranks.png": draw_ranks,
    "figure_6.png": draw_figure_6,
    "study_history.png": draw_study_history,
}


def main() -> int:
    if len(sys.argv) != 2 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: draw.py DIRECTORY (with the table.csv of a comparison)", file=sys.stderr)
        return 2
    use_style()
    write_speed_ups(directory)
    write_prices(directory)
    for name, draw in PICTURES.items():
        if draw(directory, directory / name):
            print(f"Picture: {directory / name}")
        else:
            (directory / name).unlink(missing_ok=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
