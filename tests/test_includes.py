#!/usr/bin/env python3
"""tools/check_includes.py names each kind of wrong include, and passes right ones."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parent.parent / "tools" / "check_includes.py"

# A tree in which everything is allowed.
TREE = {
    "host/base/error.hpp": "#pragma once\n#include <string>\n",
    "host/scene/scene_desc.hpp": '#include "shared/light.h"\n',
    "host/flat/flatten.cpp": '#include "base/error.hpp"\n#include "scene/scene_desc.hpp"\n',
    "host/cli/render.cpp": '#include <CLI/CLI.hpp>\n#include "version.hpp"\n',
    "host/main.cpp": '#include <CLI/CLI.hpp>\n#include "version.hpp"\n#include "base/error.hpp"\n',
    "kernels/shared/light.h": '#include <cstdint>\n#include "shared/platform.h"\n',
    "kernels/shared/platform.h": "",
    "kernels/lib/vec.cl": "",
    "kernels/phase/phase.cl": '#include "lib/vec.cl"\n',
    "kernels/passes/shade.cl": '#include "phase/phase.cl"\n#include "shared/light.h"\n',
    "tests/unit/scene/scene_texts.hpp": '#include "base/error.hpp"\n',
    "tests/unit/scene/test_reader.cpp": '#include "unit/scene/scene_texts.hpp"\n',
    "tests/unit/base/test_error.cpp": '#include "base/error.hpp"\n',
}

# File, its text, what the report must say.
WRONG = [
    ("host/base/log.cpp", '#include "scene/scene_desc.hpp"', "host/base may include base, not scene"),
    ("host/scene/reader.cpp", '#include "flat/flatten.hpp"', "not flat"),
    ("host/flat/formats/vdb.cpp", '#include "cl/context.hpp"', "not cl"),
    ("host/cli/info.cpp", '  #  include "lib/vec.cl"', "not lib"),
    ("host/main.cpp", '#include "render/renderer.hpp"', "not render"),
    ("host/scene/reader.cpp", '#include "scene/missing.hpp"', "there is no host/scene/missing.hpp"),
    ("host/scene/reader.cpp", '#include "scene_desc.hpp"', "not the root"),
    ("host/flat/bricks.cpp", '#include "version.hpp"', "only main and cli"),
    ("host/flat/bricks.cpp", "#include <openvdb/openvdb.h>", "belongs to vdb"),
    ("host/flat/bricks.h", "", "holds .hpp and .cpp files only"),
    ("host/odd/odd.cpp", "", "host/odd is no room"),
    ("kernels/lib/rng.cl", '#include "phase/phase.cl"', "kernels/lib may include shared, lib, not phase"),
    ("kernels/shared/ray.h", '#include "lib/vec.cl"', "not lib"),
    ("kernels/shared/ray.h", '#include "shared/ray.cl"', ".h files include .h files only"),
    ("kernels/shared/ray.cl", "", "holds .h files only"),
    ("kernels/passes/shade.cl", "#include <math.h>", "nothing from outside"),
    ("tests/unit/test_error.cpp", '#include "base/error.hpp"', "tests/unit is no room of host/"),
    ("tests/unit/odd/test_error.cpp", '#include "base/error.hpp"', "tests/unit/odd is no room of host/"),
    ("tests/unit/scene/test_error.cpp", '#include "base/error.hpp"', "includes nothing of scene"),
]


def report(extra):
    """Exit code and output of the check on TREE with the files of `extra` added or replaced."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in {**TREE, **extra}.items():
            path = Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + "\n", encoding="utf-8")
        run = subprocess.run([sys.executable, str(CHECK), root], capture_output=True, text=True, check=False)
        return run.returncode, run.stdout + run.stderr


class IncludesTest(unittest.TestCase):
    def test_passes_what_is_allowed(self):
        self.assertEqual(report({}), (0, "one way\n"))

    def test_names_what_is_wrong(self):
        for name, text, expected in WRONG:
            with self.subTest(f"{name}: {text}"):
                code, output = report({name: text})
                self.assertEqual(code, 1, output)
                self.assertEqual(len(output.splitlines()), 1, output)
                self.assertTrue(output.startswith(f"{name}:1: "), output)
                self.assertIn(expected, output)


if __name__ == "__main__":
    unittest.main()
