#!/usr/bin/env python3
"""The published JSON Schema accepts every scene in scenes/ and refuses broken ones; what it names stands in the README
and in the full scene of the writer's test. Not a test of brume's reader."""
import copy
import json
import re
import unittest
from pathlib import Path

from jsonschema.validators import validator_for

TESTS = Path(__file__).resolve().parent
SCENES = TESTS.parent / "scenes"
COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)

GOOD = {
    "camera": {"type": "perspective", "eye": [0, 1, 4], "target": [0, 0, 0], "up": [0, 1, 0], "vfov": 40},
    "film": {"size": [64, 64], "spp": 1, "exposure": 0},
    "background": [0, 0, 0],
    "lights": [{"type": "point", "position": [0, 4, 0], "intensity": [9, 9, 9], "falloff": "none"}],
    "materials": {"floor": {"model": "lambert", "diffuse": 0.5}},
    "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "floor"}],
    "media": [{"bounds": [[-1, -1, -1], [1, 1, 1]], "density": {"type": "constant", "value": 1}, "sigma_a": 0.1,
               "sigma_s": [1, 1, 1], "phase": {"type": "henyey_greenstein", "g": 0.65}}],
    "render": {"method": "auto", "step": 0.05, "shadow": "trace"},
}

# What is broken: where, and by which value.
BROKEN = {
    "unknown key": (["camra"], {}),
    "unknown key inside": (["film", "sise"], [64, 64]),
    "unknown camera": (["camera", "type"], "fisheye"),
    "three numbers for a size": (["film", "size"], [64, 64, 64]),
    "no samples": (["film", "spp"], 0),
    "text for a color": (["background"], "red"),
    "unknown light": (["lights", 0, "type"], "laser"),
    "two numbers for a point": (["lights", 0, "position"], [0, 4]),
    "unknown material model": (["materials", "floor", "model"], "gold"),
    "unknown shape": (["shapes", 0, "type"], "teapot"),
    "key of another shape": (["shapes", 0, "corner"], [0, 0, 0]),
    "text for a radius": (["shapes", 0, "radius"], "big"),
    "unknown density": (["media", 0, "density", "type"], "marble"),
    "g of a delta function": (["media", 0, "phase", "g"], 1),
    "negative absorption": (["media", 0, "sigma_a"], -1),
    "three numbers for a pair": (["media", 0, "density"], {"type": "file", "path": "a", "remap": [[0, 1, 2]]}),
    "negative density": (["media", 0, "density"], {"type": "file", "path": "a", "remap": [[0, -1]]}),
    "unknown rule": (["media", 0, "density"], {"type": "file", "path": "a", "level_set": "keep"}),
    "unknown method": (["render", "method"], "magic"),
}


# What the full scene cannot hold: it has one camera, images are written as their path, and this is not available yet.
NOT_IN_FULL = {"perspective", "vfov", "image", "time_budget"}


def names_in_schema(node):
    """Every key that a scene may have, and every name of a type."""
    if isinstance(node, list):
        return set().union(*map(names_in_schema, node))
    if not isinstance(node, dict):
        return set()
    properties = node.get("properties", {})
    kind = properties.get("type", {}).get("const")
    return set(properties) | ({kind} if kind else set()) | names_in_schema(list(node.values()))


def names_in_scene(node):
    if isinstance(node, list):
        return set().union(*map(names_in_scene, node))
    if not isinstance(node, dict):
        return set()
    return set(node) | {node.get("type")} | names_in_scene(list(node.values()))


def full_scene():
    text = (TESTS / "unit" / "scene" / "scene_texts.hpp").read_text(encoding="utf-8")
    return json.loads(re.search(r'SCENE_FULL = R"\((.*?)\)";', text, re.DOTALL)[1])


def scene_read(path):
    """JSON with // and /* */ comments; a string may hold either."""
    text = path.read_text(encoding="utf-8")
    return json.loads(COMMENT.sub(lambda match: match[0] if match[0].startswith('"') else " ", text))


class SchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        schema = scene_read(SCENES / "scene.schema.json")
        kind = validator_for(schema)
        kind.check_schema(schema)
        cls.validator = kind(schema)
        cls.names = names_in_schema(schema)

    def errors(self, scene):
        return [f"{error.json_path}: {error.message}" for error in self.validator.iter_errors(scene)]

    def test_accepts_every_scene(self):
        files = sorted(path for path in SCENES.rglob("*.json") if not path.name.endswith(".schema.json"))
        self.assertTrue(files, f"no scene found in {SCENES}")
        for path in files:
            with self.subTest(path.name):
                self.assertEqual(self.errors(scene_read(path)), [])

    def test_accepts_a_scene_with_every_section(self):
        self.assertEqual(self.errors(GOOD), [])

    def test_accepts_the_full_scene(self):
        self.assertEqual(self.errors(full_scene()), [])

    def test_the_full_scene_has_every_name(self):
        self.assertEqual(sorted(self.names - names_in_scene(full_scene()) - NOT_IN_FULL), [])

    def test_the_readme_has_every_name(self):
        told = set(re.findall(r"[\w-]+", " ".join(re.findall(r"`[^`]*`", (SCENES / "README.md").read_text("utf-8")))))
        self.assertEqual(sorted(self.names - told), [])

    def test_refuses_broken_scenes(self):
        for name, (place, value) in BROKEN.items():
            with self.subTest(name):
                scene = copy.deepcopy(GOOD)
                parent = scene
                for key in place[:-1]:
                    parent = parent[key]
                parent[place[-1]] = value
                self.assertNotEqual(self.errors(scene), [], f"{place} = {value!r} was accepted")


if __name__ == "__main__":
    unittest.main()
