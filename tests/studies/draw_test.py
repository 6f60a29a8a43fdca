"""Draws the pictures of a tiny comparison and looks at what came out."""

from __future__ import annotations

import contextlib
import io
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import history  # noqa: E402
import moving_boxes  # noqa: E402
import parts  # noqa: E402
import pandas as pd  # noqa: E402
import report  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.text import Text  # noqa: E402
from results import Results  # noqa: E402

TABLE = """\
method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,time_ms_min,time_ms_max,\
imbalance,lu_max_percent,messages,bytes,root_bytes_in,collectives,communicators,moved_fraction,time_vs_zoltan_rcb,error
zoltan-rcb,2,2,4,2,slope-start,scene,PARTS,1,2.0,1.5,3.0,1.0,0,1,1,1,1,0,0,1,
"rrcb-sampled[mesh=4,k=2]",2,2,4,2,slope-start,scene,PARTS,1,1.0,0.5,1.5,1.5,50,1,1,1,1,0,0,0.5,
rrcb-exact,2,2,4,2,slope-start,scene,PARTS,1,1.0,0.5,1.5,1.0,0,1,1,1,1,0,0,0.5,
zoltan-hsfc,2,2,4,2,slope-start,scene,PARTS,1,,,,,,,,,,,,,failed
"""
BOXES = "part,lower_x,lower_y,upper_x,upper_y\n"
FILES = {
    "table.csv": TABLE,
    "history.csv": """\
method,step,time,part,points,lu_percent,imbalance
rrcb,0,0.0,0,2,0,1
rrcb,0,0.0,1,2,0,1
rrcb,10,0.1,0,3,-50,1.5
rrcb,10,0.1,1,1,50,1.5
""",
    "simulation.csv": """\
method,ranks,points,steps,every,wall_s,balance_s,step_s,mean_imbalance,worst_imbalance,front_x_m,mass_kg,path_points,step_work_s,step_path_s,step_network_s,balance_work_s,balance_path_s,balance_network_s,error
none,2,4,10,0,3.0,0.0,2.5,1.4,1.5,60,1,28,2.4,1.7,0.1,0,0,0,
rrcb,2,4,10,1,2.0,0.1,1.8,1.0,1.1,60,1,20,2.4,1.2,0.1,0.1,0.05,0.01,
""",
    "data/points_slope-start_rrcb-sampled_mesh_4_k_2_.csv": """\
x,y,part
0,0,0
1,0,0
2,1,0
3,0,1
""",
    "data/boxes_slope-start_rrcb-sampled_mesh_4_k_2_.csv": """\
part,lower_x,lower_y,upper_x,upper_y
0,-inf,-inf,2.5,inf
1,2.5,-inf,inf,inf
""",
    "data/boxes_slope-start_rrcb.csv": BOXES + "0,0,0,1,2\n1,1,0,2,2\n",
    "data/boxes_slope-middle_rrcb.csv": BOXES + "0,0,0,4,2\n1,4,0,8,2\n",
    "data/points_slope-start_rrcb.csv": "x,y,part\n0,0,0\n0,1,0\n1,1,1\n2,2,1\n",
    "data/points_slope-middle_rrcb.csv": "x,y,part\n2,0,0\n3,1,0\n4,1,1\n8,2,1\n",
}


class DrawTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def write(self, *names: str) -> None:
        for name in names:
            path = self.directory / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(FILES[name])

    @property
    def results(self) -> Results:
        return Results(self.directory)

    def draw(self, *arguments: str) -> int:
        sys.argv = ["report.py", *(arguments or [str(self.directory)])]
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            return report.main()

    def pictures(self) -> list[str]:
        return sorted(path.name for path in self.directory.glob("*.png"))

    def test_draws_every_picture_of_a_complete_comparison(self) -> None:
        self.write(*FILES)
        save = Figure.savefig

        def check_and_save(figure: Figure, path: Path) -> None:
            save(figure, path)
            self.check_texts(figure, path.name)
            self.check_axes(figure, path.name)

        with unittest.mock.patch.object(Figure, "savefig", check_and_save):
            self.assertEqual(self.draw(), 0)
        self.assertEqual(self.pictures(), sorted(report.PICTURES))
        for name in self.pictures():
            self.assertEqual((self.directory / name).read_bytes()[:4], b"\x89PNG")

    def check_texts(self, figure: Figure, name: str) -> None:
        """None is lower than 10 pixels in a picture of 1280."""
        pixels = 1280 / 72 / figure.get_figwidth()
        for text in figure.findobj(Text):
            if text.get_visible() and text.get_text().strip():
                size = text.get_fontsize() * (0.7 if "^" in text.get_text() else 1)
                self.assertGreaterEqual(size * pixels, 10, f"{name}: {text.get_text()}")

    def check_axes(self, figure: Figure, name: str) -> None:
        """Logarithmic ones have two numbers at least."""
        for axes in figure.axes:
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                ticks = [low <= tick <= high for tick in axis.get_majorticklocs()]
                if axis.get_scale() == "log" and axes.get_visible():
                    self.assertGreaterEqual(sum(ticks), 2, name)

    def test_leaves_out_pictures_without_data_and_removes_old_ones(self) -> None:
        self.write("table.csv")
        (self.directory / "parts.png").write_text("of an earlier run")
        (self.directory / "holiday.png").write_text("not ours")
        self.assertEqual(self.draw(), 0)
        kept = ["holiday.png", "price.png"]
        self.assertEqual(self.pictures(), kept)

    def test_shows_points_that_have_left_the_boxes_of_the_start(self) -> None:
        self.write(*FILES)
        figure = moving_boxes.draw_moving_boxes(self.results)
        titles = [axes.get_title() for axes in figure.axes]
        self.assertEqual(titles, ["start, after a call: fullest rank 1.0000 × mean",
                                  "later, before a call: fullest rank 2.00 × mean",
                                  "later, after a call: fullest rank 1.0000 × mean"])  # fmt: skip

    def test_reads_methods_that_succeeded_only(self) -> None:
        self.write("table.csv")
        methods = self.results.table["method"].tolist()
        self.assertEqual(methods, ["zoltan-rcb", "rrcb-sampled[mesh=4,k=2]", "rrcb-exact"])

    def test_draws_a_perfect_balance_where_one_point_is(self) -> None:
        self.write("table.csv")
        # Of four points on two ranks one more is half of the mean, of 2000 a thousandth.
        self.assertEqual(self.results.table["excess"].tolist(), [0.5, 0.5, 0.5])
        path = self.directory / "table.csv"
        path.write_text(path.read_text().replace(",2,2,4,", ",2,2,2000,"))
        self.assertEqual(self.results.table["excess"].tolist(), [0.001, 0.5, 0.001])

    def test_draws_the_history_down_to_one_point(self) -> None:
        self.write("history.csv")
        self.assertEqual(history.one_point(self.results.histories()["rrcb"]), 50)

    def test_knows_the_loads_of_parts_where_every_point_is_in_the_file(self) -> None:
        self.write("table.csv")
        _, row, _ = self.results.table.itertuples()
        points = pd.DataFrame({"part": [0, 0, 0, 1]})
        self.assertEqual(parts.part_loads(points, row).tolist(), [3, 1])
        self.assertIsNone(parts.part_loads(points, row._replace(points=5)))
        self.assertIsNone(parts.part_loads(points, row._replace(imbalance=1.4)))

    def test_draws_methods_that_make_the_same_parts_once(self) -> None:
        same, other = (pd.DataFrame({"part": part}) for part in ([0, 1], [1, 0]))
        groups = parts.same_parts({("a", "x"): same, ("b", "x"): other, ("c", "x"): same})
        self.assertEqual(groups, {"a": ["a", "c"], "b": ["b"]})

    def test_arranges_the_history_by_part_and_step(self) -> None:
        self.write("history.csv")
        times, unbalance = history.per_part(self.results.histories()["rrcb"])
        self.assertEqual(times.tolist(), [0.0, 0.1])
        self.assertEqual(unbalance.tolist(), [[0.0, -50.0], [0.0, 50.0]])

    def test_every_program_names_the_package_that_it_misses(self) -> None:
        folder = Path(report.__file__).parent
        for name in ("paper", "report", "scaling", "scenes"):
            for missing in ("matplotlib", "pandas"):
                hide = (
                    "import importlib.util, runpy, sys; find = importlib.util.find_spec;"
                    f"importlib.util.find_spec = lambda n: None if n == {missing!r} else find(n);"
                    f"sys.path.insert(0, {str(folder)!r});"
                    f"runpy.run_path({str(folder / name)!r} + '.py', run_name='__main__')"
                )
                found = subprocess.run([sys.executable, "-B", "-c", hide], capture_output=True)
                self.assertEqual(found.returncode, 1)
                text = f"{missing} is missing: tools/set_up installs the Debian package python3-{missing}\n"
                self.assertEqual(found.stderr.decode(), text)

    def test_refuses_a_directory_that_is_not_there(self) -> None:
        self.assertEqual(self.draw(str(self.directory / "nowhere")), 2)


if __name__ == "__main__":
    unittest.main()
