#!/usr/bin/env python3
"""Holds the includes of host/ and kernels/ against the rooms of ARCHITECTURE: who may include whom, and which extension
may be included from where; and the folders of tests/unit, which are rooms of host/. Usage: check_includes.py [ROOT];
prints "file:line: what is wrong", exit 1 when anything is."""
import re
import sys
from pathlib import Path

# Room -> rooms it may include beside itself; "shared" is kernels/shared. The same diagram as in CMakeLists.txt.
HOST = {
    "base": "",
    "scene": "base shared",
    "volume": "base",
    "vdb": "base volume",
    "mesh": "base",
    "assimp": "base mesh",
    "accel": "base shared",
    "image": "base",
    "codec": "base image",
    "load": "base shared scene volume mesh image",
    "flat": "base shared scene volume mesh accel image load",
    "plan": "base shared scene load flat",
    "cl": "base",
    "compile": "base cl",
    "film": "base shared image",
    "reference": "base shared flat plan film",
    "render": "base shared flat plan film cl",
    "witness": "base shared flat plan film image reference",
    "chart": "base shared scene load image flat plan cl film reference render witness",
    "pilot": "base scene flat plan film image render witness chart shared",
    "check": "base shared scene volume mesh load flat plan film reference render cl",
    "stability": "base shared scene flat plan film reference render cl check",
    "cli": "base shared scene volume mesh accel image load flat plan cl film reference render witness "
    "chart pilot check stability",
    "": "base cli",  # host/main.cpp
}
KERNELS = {
    "shared": "",
    "lib": "shared",
    "shapes": "shared lib density",
    "lights": "shared lib shapes density materials",
    "phase": "shared lib",
    "density": "shared lib",
    "walk": "shared lib density",
    "media": "shared lib shapes lights phase density walk materials",
    "materials": "shared lib density shapes",
    "path": "shared lib shapes lights density walk media materials",
    "passes": "shared lib shapes lights phase density walk media materials path",
    "probes": "shared lib shapes lights phase density walk media materials path",
}
# Third-party header -> the rooms that may see it.
LIBRARIES = {
    "CL/": "cl",
    "openvdb/": "vdb",
    "tbb/": "vdb",
    "OpenImageIO/": "codec",
    "assimp/": "assimp",
    "png.h": "image",
    "CLI/": "cli",
    "nlohmann/": "base scene chart check cli",
}
# Header that the build makes -> the rooms that may see it.
GENERATED = {"version.hpp": ("", "cli"), "codec_libraries.hpp": ("codec",), "chart_texts.hpp": ("chart",)}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def room_of(path):
    return path.parts[1] if len(path.parts) > 2 else ""


def quoted_error(root, path, included):
    """What is wrong with `#include "included"` in root/path, or None."""
    in_kernels = path.parts[0] == "kernels"
    suffix, room = Path(included).suffix, included.split("/")[0] if "/" in included else ""
    if included in GENERATED:
        rooms = [room or "main" for room in GENERATED[included]]
        return None if room_of(path) in GENERATED[included] else f"only {' and '.join(rooms)} may include {included}"
    allowed = (KERNELS if in_kernels else HOST)[room_of(path)].split() + [room_of(path)]
    if room not in allowed:
        known = ", ".join(filter(None, allowed)) or "nothing"
        return f"{path.parts[0]}/{room_of(path)} may include {known}, not {room or 'the root'}"
    if suffix not in ((".h", ".cl") if in_kernels else (".h", ".hpp")):
        return f"{path.parts[0]} does not include {suffix} files"
    if path.suffix == ".h" and suffix != ".h":
        return ".h files include .h files only: both languages read them"
    folder = "kernels" if in_kernels or room == "shared" else "host"
    return None if (root / folder / included).is_file() else f"there is no {folder}/{included}"


def system_error(path, included):
    """What is wrong with `#include <included>` in path, or None."""
    if path.parts[0] == "kernels":
        return None if path.suffix == ".h" and "/" not in included else "kernels include nothing from outside"
    for prefix, rooms in LIBRARIES.items():
        if included.startswith(prefix) and room_of(path) not in rooms.split() + [""]:
            return f"<{prefix}...> belongs to {rooms}"
    return None


def file_errors(root, path):
    allowed_suffixes = (".h",) if path.parts[:2] == ("kernels", "shared") else (".cl",)
    if path.parts[0] == "host":
        allowed_suffixes = (".hpp", ".cpp")
    if path.suffix not in allowed_suffixes:
        yield 1, f"{path.parts[0]}/{room_of(path)} holds {' and '.join(allowed_suffixes)} files only"
        return
    if room_of(path) not in (HOST if path.parts[0] == "host" else KERNELS):
        yield 1, f"{path.parts[0]}/{room_of(path)} is no room: add it to tools/check_includes.py and CMakeLists.txt"
        return
    for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            quoted = match[1] == '"'
            error = quoted_error(root, path, match[2]) if quoted else system_error(path, match[2])
            if error:
                yield number, f"{match[2]}: {error}"


def unit_test_errors(root, path):
    """A unit test lies in the folder of the room that it tests."""
    room = path.parts[2] if len(path.parts) > 3 else ""
    if room not in filter(None, HOST):
        yield 1, f"{path.parent} is no room of host/"
        return
    text = (root / path).read_text(encoding="utf-8")
    if path.suffix == ".cpp" and not re.search(rf'#include "(unit/)?{room}/', text):
        yield 1, f"includes nothing of {room}: a unit test lies with the room that it tests"


def tree_errors(root):
    for folder, errors in (("host", file_errors), ("kernels", file_errors), ("tests/unit", unit_test_errors)):
        for file in sorted((root / folder).rglob("*")):
            path = file.relative_to(root)
            if file.is_file():
                for number, error in errors(root, path):
                    yield f"{path}:{number}: {error}"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent)
    errors = list(tree_errors(root))
    print("\n".join(errors) if errors else "one way")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
