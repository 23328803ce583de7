#!/usr/bin/env python3
"""ARCHITECTURE.md against the code: rooms, passes and kernel options stand in it, and the files that documents name
are there. Not a check of what it says about them."""
import importlib.util
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = ("ARCHITECTURE.md", "PICTURE.md", "README.md", "scenes/README.md")
FOLDERS = "host|kernels|tests|bench|tools|cmake|scenes"
PATH = re.compile(rf"`((?:{FOLDERS})/[\w./-]+)`")


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def rooms():
    """Name of every room, as in the table: host/base, kernels/lib."""
    spec = importlib.util.spec_from_file_location("check_includes", ROOT / "tools" / "check_includes.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return [f"host/{room}" for room in module.HOST if room] + [f"kernels/{room}" for room in module.KERNELS]


class DocumentsTest(unittest.TestCase):
    def missing(self, names):
        """The names that are in the first column of no row of ARCHITECTURE.md."""
        rows = [line.split("|")[1] for line in text_of("ARCHITECTURE.md").splitlines() if line.startswith("| ")]
        self.assertGreater(len(names), 5)  # else the pattern that found them no longer does
        return [name for name in names if not any(f"`{name}`" in row for row in rows)]

    def test_rooms(self):
        self.assertEqual(self.missing(rooms()), [])

    def test_passes(self):
        table = re.search(r"PASSES\[\] = \{(.*?)\};", text_of("host/render/passes.cpp"), re.DOTALL)[1]
        self.assertEqual(self.missing(re.findall(r'\{"(\w+)"', table)), [])

    def test_kernel_options(self):
        options = re.findall(r"^#ifndef (BRUME_\w+)  //", text_of("kernels/lib/options.cl"), re.MULTILINE)
        self.assertEqual(self.missing(options), [])

    def test_files_are_there(self):
        for name in DOCUMENTS:
            paths = [path for path in PATH.findall(text_of(name)) if "NAME" not in path and "ROOM" not in path]
            self.assertEqual([path for path in paths if not (ROOT / path).exists()], [], name)


if __name__ == "__main__":
    unittest.main()
