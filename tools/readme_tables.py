#!/usr/bin/env python3
"""Writes README's tables of times and errors from `brume bench --json`: readme_tables.py BENCH.json [README.md]. They
stand between lines `<!-- bench: NAME -->` and `<!-- end -->`. Rows that the file has no results for are left out, and
told; a table of which it has none stays as it is."""
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORKLOADS = {"fog": "fog128", "plume": "smoke"}
# Row of the table -> benchmark, without its workload.
METHODS = {
    "`--method auto --shadow trace`": "render/{}/dda_gauss2/trace",
    "`dda_midpoint`, light traced": "render/{}/dda_midpoint/trace",
    "`march_midpoint`, steps of 1 voxel, light traced": "render/{}/march_midpoint_1/trace",
    "`dda_midpoint`, `light_grid` 128": "render/{}/dda_midpoint/grid128",
    "`march_midpoint`, 1 voxel, `light_grid` 64": "render/{}/march_midpoint_1/grid64",
    "2 voxels, `light_grid` 64": "render/{}/march_midpoint_2/grid64",
    "4 voxels, `light_grid` 32": "render/{}/march_midpoint_4/grid32",
    "vdb_render 10.0.1, its defaults": "peer/{}/vdb_render",
    "Mitsuba 3.9, volpath, LLVM, 64 samples": "peer/{}/mitsuba_64spp",
}
GRIDS = (16, 32, 64, 128, 256)
GRID = "render/{}/dda_midpoint/grid%d"

ABSORPTION = {
    "VTK 9.7, `vtkFixedPointVolumeRayCastMapper`, steps of 1 voxel": "peer/{}/vtk",
    "`march_midpoint`, steps of 1 voxel": "absorb/{}/march_midpoint_1",
    "`dda_midpoint`": "absorb/{}/dda_midpoint",
    "`dda_gauss2`": "absorb/{}/dda_gauss2",
}


def seconds_text(seconds):
    return f"{seconds:.1f} s" if seconds >= 1 else f"{seconds:.2f} s"


def error_text(rel_rmse):
    percent = 100 * rel_rmse
    if percent == 0:
        return "exact"
    if percent < 0.005:
        return "< 0.01 %"
    return f"{percent:.0f} %" if percent >= 10 else f"{percent:.1f} %" if percent >= 0.995 else f"{percent:.2f} %"


def milliseconds_text(seconds):
    return f"{1000 * seconds:.0f} ms"


class Results:
    def __init__(self, results):
        self.results = results
        self.rows = {row["name"]: row for row in results["benchmarks"] if "failure" not in row}
        self.missing = []

    def cells(self, benchmark, time_text=seconds_text):
        """(time, error) on each workload; None, and told, where one is missing."""
        names = [benchmark.format(work) for work in WORKLOADS.values()]
        self.missing += [name for name in names if name not in self.rows]
        if any(name not in self.rows for name in names):
            return None
        rows = [self.rows[name] for name in names]
        return [(time_text(row["median"]), error_text(row["rel_rmse"])) for row in rows]

    def table(self, benchmarks, time_text=seconds_text):
        lines = ["| | " + " | | ".join(WORKLOADS) + " | |", "|---" * (1 + 2 * len(WORKLOADS)) + "|"]
        for label, benchmark in benchmarks.items():
            cells = self.cells(benchmark, time_text)
            if cells:
                lines.append(" | ".join([f"| {label}"] + [text for cell in cells for text in cell]) + " |")
        return lines

    def light_grids(self):
        found = {n: self.cells(GRID % n) for n in GRIDS}
        found = {n: cells for n, cells in found.items() if cells}
        lines = [" | ".join(["| cells along the longest side"] + [str(n) for n in found]) + " |"]
        lines.append("|---" * (1 + len(found)) + "|")
        for i, work in enumerate(WORKLOADS):
            texts = [f"{cells[i][1]}, {cells[i][0]}" for cells in found.values()]
            lines.append(" | ".join([f"| {work}"] + texts) + " |")
        return lines

    def measured(self):
        r = self.results
        pocl = "PoCL " + r["driver"].split("+")[0]
        driver = pocl if "Portable Computing Language" in r["device"] else f"{r['device']}, driver {r['driver']}"
        return [f"{r['size']}², one sample per pixel, {r['units']} cores, {r['lanes']} lanes, {driver}, brume "
                f"{r['version']}."]

    def blocks(self):
        """Of tables for which there are results."""
        methods, grids = self.table(METHODS), self.light_grids()
        absorption = self.table(ABSORPTION, milliseconds_text)
        blocks = {}
        if len(methods) > 2:
            blocks.update({"measured": self.measured(), "methods": methods})
        if grids[0].count("|") > 2:
            blocks["light grids"] = grids
        if len(absorption) > 2:
            blocks["absorption"] = self.measured() + [""] + absorption
        return blocks


def filled(text, blocks):
    """The text with what stands between the marks of each block replaced."""
    for name, lines in blocks.items():
        begin, end = f"<!-- bench: {name} -->\n", "<!-- end -->\n"
        if text.count(begin) != 1:
            raise ValueError(f"expected one line {begin.strip()!r}")
        before, rest = text.split(begin)
        if end not in rest:
            raise ValueError(f"no line {end.strip()!r} after {begin.strip()!r}")
        text = before + begin + "\n" + "\n".join(lines) + "\n\n" + end + rest.split(end, 1)[1]
    return text


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    readme = Path(sys.argv[2]) if len(sys.argv) == 3 else ROOT / "README.md"
    with open(sys.argv[1], encoding="utf-8") as file:
        results = Results(json.load(file))
    text = filled(readme.read_text(encoding="utf-8"), results.blocks())
    readme.write_text(text, encoding="utf-8")
    if results.missing:
        print("left out, not in " + sys.argv[1] + ": " + ", ".join(results.missing), file=sys.stderr)


if __name__ == "__main__":
    main()
