"""Chooses settings and computes sentences from small tables; writes a report and reads it."""

from __future__ import annotations

import contextlib
import html.parser
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "plots"))

import choice  # noqa: E402
import report  # noqa: E402
from document import Document, write_html  # noqa: E402
from results import Measurement  # noqa: E402
from sentences import sentences  # noqa: E402

HEADER = (
    "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,time_ms_min,"
    "time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,collectives,communicators,moved_fraction,"
    "time_vs_zoltan_rcb,error\n"
)


def measured(method: str, time: float, imbalance: float, traffic: int = 100, workload: str = "fog"):
    """A row of 1000 points on 4 ranks: exact is an imbalance of 1.004 at most."""
    return Measurement(
        method=method,
        workload=workload,
        layout="sorted",
        ranks=4,
        points=1000,
        dimension=2,
        time_ms=time,
        time_ms_min=time,
        time_ms_max=time,
        imbalance=imbalance,
        lu_percent=100 * (imbalance - 1),
        messages=1,
        bytes=traffic,
        root_bytes_in=1,
        collectives=1,
        communicators=0,
        moved_fraction=0,
    )


ROWS = [
    measured("zoltan-rcb", 8, 1.0, 4000),
    measured("rrcb-sampled", 2, 1.2),
    measured("rrcb[tol=1.05]", 1, 1.04, 100),
    measured("rrcb-exact", 2, 1.004, 200),
]


class ChoiceTest(unittest.TestCase):
    def setting(self, tolerance: str, case: str = "fog 2-D sorted", rows=None) -> str:
        chosen = choice.choices(rows or ROWS)
        return next(c.setting for c in chosen if (c.case, c.tolerance) == (case, tolerance))

    def test_takes_the_fastest_within_the_tolerance(self) -> None:
        self.assertEqual(self.setting("1.05"), "rrcb[tol=1.05]")
        self.assertEqual(self.setting("1.01"), "rrcb-exact")
        self.assertEqual(self.setting("1.001"), "zoltan-rcb")

    def test_calls_exact_what_is_one_point_above_the_mean(self) -> None:
        self.assertEqual(self.setting("exact"), "rrcb-exact")
        self.assertFalse(choice.is_within(measured("a", 1, 1.005), "exact"))

    def test_wants_the_tolerance_on_every_cloud(self) -> None:
        rows = ROWS + [
            measured("rrcb[tol=1.05]", 1, 1.2, workload="mist"),
            measured("rrcb-exact", 3, 1.0, workload="mist"),
        ]
        self.assertEqual(self.setting("1.10", choice.EVERYWHERE, rows), "rrcb-exact")

    def test_says_so_where_nothing_is_within_the_tolerance(self) -> None:
        self.assertEqual(self.setting("1.01", rows=[measured("rrcb-sampled", 2, 1.2)]), "")

    def test_keeps_on_the_front_what_none_beats_in_both(self) -> None:
        front = choice.pareto_front(ROWS, lambda row: row.time_ms)
        names = [row.method for row in front]
        self.assertEqual(names, ["rrcb[tol=1.05]", "rrcb-exact", "zoltan-rcb"])


class SentencesTest(unittest.TestCase):
    def test_compute_their_numbers(self) -> None:
        exactness, zoltan, paper = sentences(ROWS)
        self.assertIn("2 times the time", exactness)
        self.assertIn("2 times its bytes", exactness)
        self.assertIn("4 times the time", zoltan)
        self.assertIn("20 times its bytes", zoltan)
        self.assertIn("0.5 times its time and left 1.04000", paper)

    def test_are_three_without_anything_to_compare(self) -> None:
        self.assertEqual(len(sentences([])), 3)


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

    def write(self, arguments: str) -> str:
        (self.directory / "run.txt").write_text(f"rrcb 1\narguments: {arguments}\nranks: 4\n")
        sys.argv = ["report.py", str(self.directory)]
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            self.assertEqual(report.main(), 0)
        return output.getvalue()

    def test_holds_its_pictures_and_refers_to_nothing_else(self) -> None:
        row = '"rrcb[mesh=4,tol=1.1]",4,4,1000,2,<fog>,sorted,PARTS,1,1,1,1,1,0,1,1,1,1,0,0,,\n'
        (self.directory / "table.csv").write_text(HEADER + row)
        (self.directory / "parts.png").write_bytes(b"picture")
        self.write("--cloud=fog")
        text = (self.directory / "report.html").read_text()
        tags = Tags()
        tags.feed(text)
        self.assertEqual(tags.sources, ["data:image/png;base64,cGljdHVyZQ=="])
        self.assertIn("&lt;fog&gt; 2-D sorted: 1,000 points, 4 ranks", text)
        markdown = (self.directory / "report.md").read_text()
        self.assertIn("| rrcb[mesh=4,tol=1.1] | 1.00000 |", markdown)
        self.assertIn("](parts.png)", markdown)

    def test_folds_long_tables_up(self) -> None:
        document = Document("all")
        document.table("short", ["n"], [["1"]] * 80)
        document.table("long", ["n"], [["1"]] * 81)
        write_html(document, self.directory)
        text = (self.directory / "report.html").read_text()
        self.assertIn('<p class="caption">short</p>', text)
        self.assertIn('<details><summary class="caption">long, 81 rows</summary>', text)

    def test_of_a_sweep_tells_which_setting_for_which_tolerance(self) -> None:
        rows = "".join(
            f"rrcb,4,4,1000,2,{cloud},sorted,PARTS,1,1,1,1,1.04,4,1,1,1,1,0,0,,\n"
            for cloud in ("fog", "mist")
        )
        (self.directory / "sweep.csv").write_text(HEADER + rows)
        output = self.write("--sweep --quick")
        self.assertRegex(output, r"all of these +1\.05 +rrcb +1\.00")
        self.assertRegex(output, r"all of these +1\.01 +none")
        self.assertRegex(output, r"mist 2-D sorted +(rrcb 1\.00\s–×  ){2}none +none +none")
        written = (self.directory / "choices.csv").read_text().splitlines()
        self.assertIn("fog 2-D sorted,1.05,rrcb,1.0,,1.04", written)
        self.assertIn("fog 2-D sorted,exact,,,,", written)
        fronts = (self.directory / "fronts.csv").read_text().splitlines()
        self.assertEqual(fronts[1:3], ["fog 2-D sorted,time_ms,rrcb,1.0,1.04",
                                       "fog 2-D sorted,bytes,rrcb,1,1.04"])


if __name__ == "__main__":
    unittest.main()
