#!/usr/bin/env python3
"""Every [Key] cited in a source stands in REFERENCES.md, once and in order; every entry there is cited, and by the
files that it names. Every section of PICTURE.md that is cited is there. Not a check of authors, titles and links."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CITING = ("host", "kernels", "tests", "bench", "ARCHITECTURE.md", "PICTURE.md", "README.md", "scenes/README.md")
SUFFIXES = {".cpp", ".hpp", ".h", ".cl", ".md"}
KEY = r"[A-Z][a-z][A-Za-z]*[0-9]{2}[a-z]?"
CITATION = re.compile(rf"\[({KEY})(?:, [^\]\n]*)?\]")  # [Key] or [Key, where in it]
ENTRY = re.compile(rf"^\*\*\[({KEY})\]\*\* ", re.MULTILINE)
FILE = re.compile(r"`((?:host|kernels|tests|bench)/[^`]+|[A-Z]+\.md)`")
SECTION = re.compile(r"PICTURE, \*?([A-Z][A-Za-z ]*?)\*?(?=[).;:,]| and |$)", re.MULTILINE)
OWN_SECTION = re.compile(r"(?<!\*)\*([A-Z][A-Za-z ]+)\*(?!\*)")  # as PICTURE.md cites its own
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def text_of(path):
    return path.read_text(encoding="utf-8")


def citing_files():
    for name in CITING:
        path = ROOT / name
        yield from [path] if path.is_file() else sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES)


def citations():
    """Key -> the files that cite it, relative to the root."""
    found = {}
    for path in citing_files():
        for key in CITATION.findall(text_of(path)):
            found.setdefault(key, set()).add(str(path.relative_to(ROOT)))
    return found


class ReferencesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = text_of(ROOT / "REFERENCES.md")
        cls.entries = ENTRY.findall(cls.text)
        cls.cited = citations()

    def test_there_are_citations(self):
        self.assertGreater(len(self.cited), 5)  # else the patterns above no longer find anything

    def test_every_citation_has_an_entry(self):
        missing = {key: sorted(files) for key, files in self.cited.items() if key not in self.entries}
        self.assertEqual(missing, {})

    def test_every_entry_is_cited(self):
        self.assertEqual([key for key in self.entries if key not in self.cited], [])

    def test_entries_stand_once_in_order(self):
        self.assertEqual(self.entries, sorted(set(self.entries)))

    def test_entries_name_files_that_cite_them(self):
        for entry in self.text.split("\n\n"):
            for key in ENTRY.findall(entry):
                named = set(FILE.findall(entry))
                self.assertTrue(named, f"{key} names no file")
                self.assertEqual(named - self.cited.get(key, set()), set(), key)

    def test_sections_of_the_definition_are_there(self):
        picture = text_of(ROOT / "PICTURE.md")
        cited = {(path.name, name) for path in citing_files() for name in SECTION.findall(text_of(path))}
        own = {("PICTURE.md", name) for name in OWN_SECTION.findall(picture)}
        self.assertGreater(len(cited), 5)  # else the patterns above no longer find anything
        self.assertGreater(len(own), 5)
        headings = HEADING.findall(picture)
        self.assertEqual(sorted(entry for entry in cited | own if entry[1] not in headings), [])

    def test_pattern_tells_citations_from_code(self):
        for text, keys in (("[Kay86]", ["Kay86"]), ("[Jarzynski20, pcg4d]", ["Jarzynski20"]),
                           ("[Smith07b]", ["Smith07b"]), ("names[UINT16]", []), ("[chapter §4]", []), ("data[i]", [])):
            with self.subTest(text):
                self.assertEqual(CITATION.findall(text), keys)


if __name__ == "__main__":
    unittest.main()
