"""Chooses settings and fills tables from small ones; writes a report and reads it."""

from __future__ import annotations

import base64
import contextlib
import html.parser
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import choice  # noqa: E402
import pandas as pd  # noqa: E402
import report  # noqa: E402
from document import Document  # noqa: E402
from results import is_within, measurements  # noqa: E402
from tables import ghost_table, method_table, simulation_table  # noqa: E402

HEADER = (
    "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,time_ms_min,"
    "time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,collectives,communicators,moved_fraction,"
    "time_vs_zoltan_rcb,error\n"
)


def measured(
    method: str,
    time: float,
    imbalance: float,
    traffic: int = 100,
    workload: str = "fog",
    spread: float | None = None,
) -> dict:
    """A row of 1000 points on 4 ranks: exact is an imbalance of 1.004 at most.

    Intervals of the time and its share of Zoltan's 8 ms reach `spread` times it to both sides."""
    row = {
        "method": method, "workload": workload, "layout": "sorted", "ranks": 4, "points": 1000,
        "dim": 2, "time_ms_median": time, "time_ms_min": time, "time_ms_max": time,
        "imbalance": imbalance, "lu_max_percent": 100 * (imbalance - 1), "messages": 1,
        "bytes": traffic, "root_bytes_in": 1, "moved_fraction": 0, "time_vs_zoltan_rcb": time / 8,
    }  # fmt: skip
    for end, factor in () if spread is None else (("low", 1 - spread), ("high", 1 + spread)):
        row |= {f"time_ms_{end}": time * factor, f"time_vs_zoltan_rcb_{end}": time * factor / 8}
    return row


def table(*rows: dict) -> pd.DataFrame:
    return measurements(pd.DataFrame(rows))


def simulated(method: str, path: float, spread: float, speed_up: float) -> dict:
    row = {
        "method": method, "ranks": 4, "points": 1000, "steps": 10, "wall_s": 9,
        "mean_imbalance": 1.25, "critical_path_s": path, "speed_up_critical_path": speed_up,
        "rebalances": 2, "moved_fraction": 0.125,
    }  # fmt: skip
    for end, way in (("low", -spread), ("high", spread)):
        row[f"critical_path_s_{end}"] = path + way
        row[f"speed_up_critical_path_{end}"] = speed_up + way
    return row


def runs(*rows: dict) -> pd.DataFrame:
    return pd.DataFrame(rows)


ROWS = [
    measured("zoltan-rcb", 8, 1.0, 4000),
    measured("rrcb-sampled", 2, 1.2),
    measured("rrcb[tol=1.05]", 1, 1.04, 100),
    measured("rrcb-exact", 2, 1.004, 200),
]


class ChoiceTest(unittest.TestCase):
    def setting(self, tolerance: str, case: str = "fog 2-D sorted", rows=None) -> str:
        chosen = choice.choices(table(*(rows or ROWS)))
        return next(c.setting for c in chosen if (c.case, c.tolerance) == (case, tolerance))

    def test_takes_the_fastest_within_the_tolerance(self) -> None:
        self.assertEqual(self.setting("1.05"), "rrcb[tol=1.05]")
        self.assertEqual(self.setting("1.01"), "rrcb-exact")
        self.assertEqual(self.setting("1.001"), "zoltan-rcb")

    def test_calls_exact_what_is_one_point_above_the_mean(self) -> None:
        self.assertEqual(self.setting("exact"), "rrcb-exact")
        self.assertFalse(is_within(table(measured("a", 1, 1.005)), "exact").any())

    def test_wants_the_tolerance_on_every_cloud(self) -> None:
        rows = ROWS + [
            measured("rrcb[tol=1.05]", 1, 1.2, workload="mist"),
            measured("rrcb-exact", 3, 1.0, workload="mist"),
        ]
        self.assertEqual(self.setting("1.10", choice.EVERYWHERE, rows), "rrcb-exact")

    def test_says_so_where_nothing_is_within_the_tolerance(self) -> None:
        self.assertEqual(self.setting("1.01", rows=[measured("rrcb-sampled", 2, 1.2)]), "")

    def test_keeps_on_the_front_what_none_beats_in_both(self) -> None:
        beaten = measured("zoltan-rib", 9, 1.1)
        names = choice.pareto_front(table(*ROWS, beaten))["method"].tolist()
        self.assertEqual(names, ["rrcb[tol=1.05]", "rrcb-exact", "zoltan-rcb"])


class GhostTest(unittest.TestCase):
    GHOSTS = {"ghosts": 500, "ghosts_max": 200, "neighbours_max": 3, "off_machine_ghosts": 125}

    def test_are_shares_of_the_points_and_of_the_ghosts(self) -> None:
        (row,) = ghost_table(table(measured("rrcb", 1, 1.0) | self.GHOSTS))
        self.assertEqual(list(row.values()), ["rrcb", "500", "50.0", "200", "3", "25.0"])

    def test_need_no_machines(self) -> None:
        one_machine = self.GHOSTS | {"off_machine_ghosts": float("nan")}
        (row,) = ghost_table(table(measured("rrcb", 1, 1.0) | one_machine))
        self.assertEqual(list(row)[-1], "most neighbours")
        self.assertEqual(ghost_table(table(*ROWS)), [])


class NoiseTest(unittest.TestCase):
    def test_names_no_fastest_setting_within_the_noise(self) -> None:
        rows = [measured("a", 2.0, 1.0, spread=0.1), measured("b", 2.3, 1.0, spread=0.1)]
        self.assertEqual(choice.choices(table(*rows))[0].remark, " (not told apart from b)")
        rows = [measured("a", 2.0, 1.0, spread=0.05), measured("b", 2.3, 1.0, spread=0.05)]
        self.assertEqual(choice.choices(table(*rows))[0].remark, "")

    def test_tells_no_method_apart_whose_ratio_may_be_one(self) -> None:
        rows = [
            measured("zoltan-rcb", 8, 1.0, spread=0.0),
            measured("close", 7.6, 1.0, spread=0.1),
            measured("fast", 4, 1.0, spread=0.1),
        ]
        cells = {row["method"]: row["times as fast"] for row in method_table(table(*rows))}
        self.assertEqual(cells["zoltan-rcb"], "1.00")
        self.assertEqual(cells["close"], "1.05 [0.96, 1.17], not told apart")
        self.assertEqual(cells["fast"], "2.00 [1.82, 2.22]")

    def test_shows_the_sign_of_the_largest_unbalance_where_it_is_known(self) -> None:
        row = measured("a", 1, 1.2)
        for worst, text in (({}, "±20.000"), (-20.0, "-20.000"), (-0.0, "0.000")):
            known = row | ({"lu_worst_percent": worst} if worst != {} else {})
            (cells,) = method_table(table(known))
            self.assertEqual(cells["largest |Lu|, signed %"], text)

    def test_leads_a_simulation_with_its_critical_path(self) -> None:
        rows = runs(simulated("none", 2.0, 0.0, 1.0), simulated("rrcb", 1.6, 0.1, 1.25))
        table = simulation_table(rows, "none")
        self.assertEqual(list(table[0])[2], "critical path s")
        none, rrcb = (list(row.values()) for row in table)
        self.assertEqual(none[2:4], ["2.000", "1.00"])
        self.assertEqual(rrcb[2:4], ["1.600 [1.500, 1.700]", "1.25 [1.15, 1.35]"])
        self.assertEqual(rrcb[5:7], ["2", "12.5"])

    def test_keeps_four_digits_of_short_simulations(self) -> None:
        run = simulated("rrcb", 0.0123456, 0.0, 1.0) | {"wall_s": 0.5}
        (row,) = simulation_table(runs(run), "none")
        self.assertEqual((row["critical path s"], row["wall s"]), ("0.01235", "0.50000"))



class Tags(html.parser.HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.sources: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.sources += [value or "" for name, value in attributes if name in ("src", "href")]


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def write(self, arguments: str, record: str = "") -> str:
        text = f"rrcb 1\narguments: {arguments}\nranks: 4\n{record}"
        (self.directory / "run.txt").write_text(text)
        sys.argv = ["report.py", str(self.directory)]
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            self.assertEqual(report.main(), 0)
        return output.getvalue()

    def test_holds_its_pictures_and_refers_to_nothing_else(self) -> None:
        row = '"rrcb[mesh=4,tol=1.1]",4,4,1000,2,<fog>,sorted,PARTS,1,1,1,1,1,0,1,1,1,1,0,0,,\n'
        (self.directory / "table.csv").write_text(HEADER + row)
        self.write("--cloud=fog")
        text = (self.directory / "report.html").read_text()
        tags = Tags()
        tags.feed(text)
        picture = (self.directory / "price.png").read_bytes()
        data = base64.b64encode(picture).decode()
        self.assertEqual(tags.sources, [f"data:image/png;base64,{data}"])
        self.assertIn("&lt;fog&gt; 2-D sorted: 1,000 points, 4 ranks", text)
        markdown = (self.directory / "report.md").read_text()
        self.assertIn("| rrcb[mesh=4,tol=1.1] | 1.00000 |", markdown)
        self.assertIn("](price.png)", markdown)
        self.assertIn("largest \\|Lu\\|", markdown)

    def test_folds_long_tables_up(self) -> None:
        document = Document("all", self.directory)
        document.table("short", [{"n": "1"}] * 80)
        document.table("long", [{"n": "1"}] * 81)
        document.write()
        text = (self.directory / "report.html").read_text()
        self.assertIn('<p class="caption">short</p>', text)
        self.assertIn('<details><summary class="caption">long, 81 rows</summary>', text)

    def test_begins_with_a_busy_machine_and_with_shared_cores(self) -> None:
        row = "rrcb,999,999,9990,2,fog,sorted,PARTS,1,1,1,1,1,0,1,1,1,1,0,0,,\n"
        (self.directory / "table.csv").write_text(HEADER + row)
        record = "processor time used by other processes: 23 %\nbusy: yes\n"
        output = self.write("--cloud=fog", record)
        lines = [line for line in output.splitlines() if line and not line.startswith("Picture")]
        self.assertIn("The machine was busy: other processes used 23 %", lines[0])
        markdown = (self.directory / "report.md").read_text()
        self.assertIn("999 ranks share", markdown)


if __name__ == "__main__":
    unittest.main()
