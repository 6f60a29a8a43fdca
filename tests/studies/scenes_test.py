"""The table of several scenes, from files made by hand."""

from __future__ import annotations

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import scenes  # noqa: E402
from results import Results  # noqa: E402

HEADER = (
    "method,round,seed,ranks,points,steps,every,wall_s,balance_s,step_s,mean_imbalance,worst_imbalance,"
    "front_x_m,moved_m,mass_kg,path_points,step_work_s,step_path_s,step_network_s,balance_work_s,"
    "balance_path_s,balance_network_s,critical_path_s,rebalances,moved_fraction,error,scene\n"
)
REST = ",,1,5,8,1,1,0,0,0,0,1,0,0,,slope"
HISTORY = """\
method,step,time,part,points,lu_percent,imbalance
none,0,0.0,0,3,-50,1.5
none,0,0.0,1,1,50,1.5
"""


class ScenesTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def write(self, scene: str, rows: list[str]) -> None:
        folder = self.directory / scene
        folder.mkdir()
        folder.joinpath("simulation_runs.csv").write_text(HEADER + "\n".join(rows) + "\n")
        folder.joinpath("history.csv").write_text(HISTORY)

    def run_script(self, *names: str) -> int:
        sys.argv = ["scenes.py", str(self.directory), *names]
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            return scenes.main()

    def test_sets_scenes_side_by_side(self) -> None:
        none = "none,1,,2,4,10,5,1,0,1,1.5,1.75" + REST
        rrcb = "rrcb,1,,2,4,10,5,1,0,1,1.0625,1.25" + REST
        failed = "rrcb,1,,2,4,10,5" + "," * 19 + "it fell,slope"
        self.write("slope", [none, rrcb])
        self.write("beam", [none, failed])
        self.assertEqual(self.run_script("slope", "beam", "not_run"), 0)
        found = {name: Results(self.directory / name) for name in ("slope", "beam")}
        self.assertEqual(
            scenes.table(found),
            "| method | slope | beam |\n|---|---|---|\n"
            "| `none` | 1.5000 (1.750) | 1.5000 (1.750) |\n"
            "| `rrcb` | 1.0625 (1.250) |  |",
        )
        self.assertEqual((self.directory / "scenes.png").read_bytes()[:4], b"\x89PNG")

    def test_needs_a_scene_that_ran(self) -> None:
        self.assertEqual(self.run_script("slope"), 1)
        self.assertEqual(self.run_script(), 2)


if __name__ == "__main__":
    unittest.main()
