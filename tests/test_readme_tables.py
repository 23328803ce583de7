#!/usr/bin/env python3
"""tools/readme_tables.py: what it writes of results, that README has the places for it, and that the benchmarks it
reads are there."""
import importlib.util
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def tool():
    spec = importlib.util.spec_from_file_location("readme_tables", ROOT / "tools" / "readme_tables.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


TOOL = tool()


def names(work):
    benchmarks = list(TOOL.METHODS.values()) + [TOOL.GRID % n for n in TOOL.GRIDS] + list(TOOL.ABSORPTION.values())
    return [name.format(work) for name in benchmarks]


def results(left_out=()):
    rows = [{"name": name, "median": 0.0512 + i, "rel_rmse": 0.00034 * i * i, "seconds": [1]}
            for work in TOOL.WORKLOADS.values() for i, name in enumerate(names(work)) if name not in left_out]
    return {"version": "1.2 (abc)", "device": "x (Portable Computing Language)", "driver": "3.1+debian", "units": 2,
            "lanes": 8, "size": 512, "benchmarks": rows}


def block(text, name):
    return text.split(f"<!-- bench: {name} -->\n")[1].split("<!-- end -->")[0].strip().splitlines()


class ReadmeTablesTest(unittest.TestCase):
    def test_cells(self):
        made = TOOL.Results(results())
        methods = made.table(TOOL.METHODS)
        self.assertEqual(methods[0], "| | fog | | plume | |")
        self.assertEqual(methods[2], "| `--method auto --shadow trace` | 0.05 s | exact | 0.05 s | exact |")
        self.assertEqual(methods[3], "| `dda_midpoint`, light traced | 1.1 s | 0.03 % | 1.1 s | 0.03 % |")
        self.assertEqual(methods[10], "| Mitsuba 3.9, volpath, LLVM, 64 samples | 8.1 s | 2.2 % | 8.1 s | 2.2 % |")
        self.assertEqual(TOOL.error_text(4e-5), "< 0.01 %")
        self.assertEqual(made.light_grids()[0], "| cells along the longest side | 16 | 32 | 64 | 128 | 256 |")
        self.assertTrue(made.light_grids()[2].startswith("| fog | 2.8 %, 9.1 s | 3.4 %, 10.1 s |"))
        absorption = made.table(TOOL.ABSORPTION, TOOL.milliseconds_text)
        self.assertEqual(absorption[5], "| `dda_gauss2` | 17051 ms | 9.8 % | 17051 ms | 9.8 % |")
        self.assertEqual(made.measured(),
                         ["512², one sample per pixel, 2 cores, 8 lanes, PoCL 3.1, brume 1.2 (abc)."])
        self.assertEqual(made.missing, [])

    def test_rows_without_results_are_left_out_and_told(self):
        made = TOOL.Results(results(["peer/smoke/mitsuba_64spp", TOOL.GRID.format("fog128") % 16]))
        self.assertEqual(len(made.table(TOOL.METHODS)), 2 + len(TOOL.METHODS) - 1)
        self.assertEqual(made.light_grids()[0], "| cells along the longest side | 32 | 64 | 128 | 256 |")
        self.assertEqual(made.missing, ["peer/smoke/mitsuba_64spp", "render/fog128/dda_midpoint/grid16"])

    def test_readme_has_the_places(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        blocks = TOOL.Results(results()).blocks()
        text = TOOL.filled(readme, blocks)
        self.assertEqual(TOOL.filled(text, blocks), text)
        for name, lines in blocks.items():
            self.assertEqual(block(text, name), lines)
            labels = [line.split("|")[1] for line in block(readme, name) if "|" in line]
            self.assertEqual(labels, [line.split("|")[1] for line in lines if "|" in line], name)
        outside = re.compile(r"<!-- bench.*?<!-- end -->", re.DOTALL)
        self.assertEqual(outside.sub("", text), outside.sub("", readme))

    def test_tables_without_results_stay(self):
        absorption = list(TOOL.ABSORPTION.values())
        others = [name for work in TOOL.WORKLOADS.values() for name in names(work)
                  if name not in [row.format(work) for row in absorption]]
        self.assertEqual(list(TOOL.Results(results(others)).blocks()), ["absorption"])
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        text = TOOL.filled(readme, TOOL.Results(results(others)).blocks())
        self.assertEqual(block(text, "methods"), block(readme, "methods"))
        self.assertIn("| `dda_gauss2` | 17051 ms | 9.8 % | 17051 ms | 9.8 % |", block(text, "absorption"))

    def test_marks_that_are_missing_are_an_error(self):
        with self.assertRaisesRegex(ValueError, "expected one line '<!-- bench: methods -->'"):
            TOOL.filled("no marks", {"methods": []})
        with self.assertRaisesRegex(ValueError, "no line '<!-- end -->'"):
            TOOL.filled("<!-- bench: methods -->\n", {"methods": []})

    def test_benchmarks_are_there(self):
        sources = "".join(file.read_text(encoding="utf-8") for file in sorted((ROOT / "bench").glob("*.cpp")))
        for name in names("{}"):
            kind, _, setting = name.split("/", 2)
            self.assertIn(f'"{kind}/"', sources)
            self.assertIn(f'/{setting}"' if kind == "peer" else f'"{setting}"', sources)
        for work in TOOL.WORKLOADS.values():
            self.assertIn(f'workload("{work}"', sources)


if __name__ == "__main__":
    unittest.main()
