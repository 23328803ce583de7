#!/usr/bin/env python3
"""The page of a chart in a real browser, headless Chromium: sorts its table, clicks a mark and a row, and looks at what
is shown then. Long: a chart is measured first. Usage: test_chart_page.py BRUME"""
import functools
import http.server
import json
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
BUILT = Path(__file__).resolve().parent.parent / "build" / "brume"
BRUME = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else BUILT
SCENE = {"camera": {"eye": [1.5, 1.2, 3]}, "film": {"size": [24, 18]},
         "lights": [{"type": "directional", "direction": [1, -1, -0.5], "irradiance": 5}],
         "media": [{"density": {"type": "perlin", "resolution": [16, 16, 16]}, "sigma_a": 0.2, "sigma_s": 1}]}

# What a visitor does, by real events on what is there; what is seen meanwhile is sent back as JSON.
VISIT = """
<script>
window.addEventListener("load", async () => {
  const seen = {failures: []};
  window.addEventListener("error", e => seen.failures.push(String(e.message)));
  const rows = () => [...document.querySelectorAll("#points tbody tr")].map(r => r.dataset.id);
  const header = key => document.querySelector(`#points th[data-key=${key}]`);
  const click = node => node.dispatchEvent(new MouseEvent("click", {bubbles: true}));
  const shown = async () => {
    const images = ["exact", "picture", "error"].map(id => document.getElementById(id));
    await Promise.all(images.map(i => i.decode()));
    return {sizes: images.map(i => [i.naturalWidth, i.naturalHeight]),
      seen: images.map(i => i.getBoundingClientRect().width > 50),
      picture: images[1].src, error: images[2].src, caption: document.getElementById("caption").textContent,
      rows: [...document.querySelectorAll(".row-chosen")].map(r => r.dataset.id),
      marks: [...document.querySelectorAll(".chosen")].map(m => m.dataset.id)};
  };
  try {
    seen.first = rows();
    seen.title = document.title;
    const place = m => [m.dataset.id, m.getBoundingClientRect().x, m.getBoundingClientRect().y];
    seen.marks = [...document.querySelectorAll(".mark")].map(place);
    click(header("seconds").querySelector("button"));
    seen.quickest = [rows(), header("seconds").getAttribute("aria-sort")];
    click(header("seconds").querySelector("button"));
    seen.slowest = [rows(), header("seconds").getAttribute("aria-sort")];
    click(header("light_grid").querySelector("button"));
    seen.grids = rows();
    const mark = [...document.querySelectorAll(".mark")].pop();
    click(mark);
    seen.mark = [mark.dataset.id, await shown()];
    const row = document.querySelector("#points tbody tr:nth-child(3)");
    click(row);
    seen.row = [row.dataset.id, await shown()];
    seen.outside = performance.getEntriesByType("resource").map(r => r.name).filter(n => !n.startsWith("data:"));
  } catch (error) { seen.failures.push(String(error)); }
  await fetch("seen", {method: "POST", body: JSON.stringify(seen)});
});
</script>
"""


class Pages(http.server.SimpleHTTPRequestHandler):
    """Serves a folder and keeps what is posted: the visit ends by its own word and not by a clock."""
    seen = queue.Queue()

    def do_POST(self):
        self.seen.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


def visit(folder, page, seconds=120):
    """What the browser sends back of a page in a folder. Fails with the browser's own words if nothing comes."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Pages, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with server, open(folder / "browser.log", "w+") as log:
        browser = subprocess.Popen(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--remote-debugging-port=0", f"--user-data-dir={folder}/profile", "--window-size=1400,1200",
             f"http://127.0.0.1:{server.server_port}/{page}"], stdout=log, stderr=log)
        try:
            return Pages.seen.get(timeout=seconds)
        except queue.Empty:
            log.seek(0)
            raise AssertionError(f"nothing seen in {seconds} s; {BROWSER} said:\n{log.read()[-3000:]}") from None
        finally:
            browser.terminate()
            browser.wait(timeout=60)
            server.shutdown()


@unittest.skipUnless(BROWSER, "SKIPPED: there is no chromium here")
class ChartPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="brume_chart_page_", ignore_cleanup_errors=True)
        folder = Path(cls.folder.name)
        (folder / "fog.json").write_text(json.dumps(SCENE))
        subprocess.run([BRUME, "chart", "fog.json", "-o", "out", "--quiet", "--methods", "dda_midpoint,march_midpoint"],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        cls.chart = json.loads((folder / "out/chart.json").read_text())
        page = (folder / "out/chart.html").read_text()
        cls.images = json.loads(re.search(r'id="pictures-data">(.*?)</script>', page, re.DOTALL)[1])["points"]
        (folder / "visit.html").write_text(page.replace("</body>", VISIT + "</body>"))
        cls.seen = visit(folder, "visit.html")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def key(self, name):
        return {p["id"]: p[name] for p in self.chart["points"]}

    def test_nothing_fails_and_nothing_is_loaded_from_elsewhere(self):
        self.assertEqual(self.seen["failures"], [])
        self.assertEqual(self.seen["outside"], [])
        self.assertEqual(self.seen["title"], "brume chart: fog.json")

    def test_a_row_and_a_mark_for_every_point(self):
        ids = [p["id"] for p in self.chart["points"]]
        self.assertEqual(self.seen["first"], ids)
        self.assertEqual(sorted(mark for mark, _, _ in self.seen["marks"]), sorted(ids))

    def test_left_is_quicker_and_down_is_closer(self):
        seconds, errors = self.key("seconds"), self.key("rel_rmse")
        by_x = sorted(self.seen["marks"], key=lambda m: seconds[m[0]])
        by_y = sorted(self.seen["marks"], key=lambda m: -errors[m[0]])
        self.assertLess(by_x[0][1] + 50, by_x[-1][1])
        self.assertLess(by_y[0][2] + 50, by_y[-1][2])
        for a, b in zip(by_x, by_x[1:]):
            self.assertLessEqual(a[1], b[1] + 6)  # shapes are not equally wide

    def test_the_table_sorts_both_ways(self):
        seconds = self.key("seconds")
        order = sorted(seconds.values())
        self.assertEqual([seconds[i] for i in self.seen["quickest"][0]], order)
        self.assertEqual(self.seen["quickest"][1], "ascending")
        self.assertEqual([seconds[i] for i in self.seen["slowest"][0]], order[::-1])
        self.assertEqual(self.seen["slowest"][1], "descending")

    def test_empty_cells_sort_last(self):
        grids = [self.key("light_grid")[i] for i in self.seen["grids"]]
        filled = [g for g in grids if g is not None]
        self.assertTrue(filled and len(filled) < len(grids))
        self.assertEqual(grids, sorted(filled) + [None] * (len(grids) - len(filled)))

    def test_a_click_shows_the_pictures_of_that_point(self):
        self.assertNotEqual(self.seen["mark"][0], self.seen["row"][0])
        for point, shown in (self.seen["mark"], self.seen["row"]):
            self.assertEqual(shown["rows"], [point])
            self.assertEqual(shown["marks"], [point])
            self.assertEqual(shown["picture"], self.images[point]["picture"])
            self.assertEqual(shown["error"], self.images[point]["error"])
            self.assertEqual(shown["sizes"], [[24, 18]] * 3)
            self.assertEqual(shown["seen"], [True] * 3)
            self.assertTrue(shown["caption"].startswith(point + ": "), shown["caption"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
