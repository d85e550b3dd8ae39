#!/usr/bin/env python3
"""The code keeps to the layers that docs/architecture.md draws, and the drawing keeps to the code."""

import pathlib
import re
import sys
import unittest

import layers

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
FLOORS = layers.drawn_floors(PAGE)
HEIGHTS = layers.heights(FLOORS)


class Includes(unittest.TestCase):
    def test_no_file_reaches_above_or_beside_its_layer(self):
        sources = layers.layered_sources(ROOT)
        self.assertGreater(len(sources), 150)
        found = [fault for path in sources
                 for fault in layers.faults(path, (ROOT / path).read_text(encoding="utf-8"), HEIGHTS)]
        self.assertEqual([], found)

    def test_no_file_is_outside_of_the_drawing(self):
        self.assertEqual([], [path for path in layers.layered_sources(ROOT)
                              if layers.home_of(path, HEIGHTS) is None])


class Drawing(unittest.TestCase):
    def test_every_folder_that_is_drawn_or_listed_exists(self):
        rows = re.findall(r"^\| (`[^|]*`) +\|", PAGE, re.MULTILINE)
        listed = {folder for row in rows for folder in re.findall(r"`([^`]+/)`", row)}
        self.assertGreater(len(listed), 20)
        self.assertEqual([], [folder for folder in sorted(listed | set(HEIGHTS))
                              if not (ROOT / folder).is_dir()])

    def test_every_folder_of_code_is_drawn_or_listed(self):
        rows = re.findall(r"^\| (`[^|]*`) +\|", PAGE, re.MULTILINE)
        listed = {folder for row in rows for folder in re.findall(r"`([^`]+/)`", row)}
        self.assertEqual([], sorted(layers.source_folders(ROOT) - listed))
        self.assertEqual([], sorted(set(HEIGHTS) - listed))


class TheCheckItself(unittest.TestCase):
    """It notices each kind of fault, and nothing else."""

    heights = layers.heights([["top/"], ["left/", "right/"], ["right/inner/"], ["bottom/"]])

    def faults(self, path, include):
        return list(layers.faults(path, f"#include {include}\n", self.heights))

    def test_reads_a_floor_with_several_folders(self):
        page = "# A\n\n## Layers\n\n```\ntop/          words\n  a/b/ | c/   more words\n     ▲\n```\n"
        self.assertEqual([["top/"], ["a/b/", "c/"]], layers.drawn_floors(page))

    def test_down_is_allowed(self):
        self.assertEqual([], self.faults("top/a.cpp", '"left/b.hpp"'))
        self.assertEqual([], self.faults("left/a.cpp", '"left/b.hpp"'))
        self.assertEqual([], self.faults("right/a.cpp", '"right/inner/b.hpp"'))
        self.assertEqual([], self.faults("left/a.cpp", "<vector>"))

    def test_up_and_beside_are_faults(self):
        self.assertIn("top/ is above bottom/", self.faults("bottom/a.cpp", '"top/b.hpp"')[0])
        self.assertIn("right/ is beside left/", self.faults("left/a.cpp", '"right/b.hpp"')[0])
        self.assertIn("right/ is above right/inner/",
                      self.faults("right/inner/a.cpp", '"right/b.hpp"')[0])

    def test_an_include_must_name_its_layer(self):
        self.assertIn("root", self.faults("top/a.cpp", '"b.hpp"')[0])
        self.assertIn("root", self.faults("top/a.cpp", '"../left/b.hpp"')[0])
        self.assertIn("no layer", self.faults("top/a.cpp", '"tests/support/b.hpp"')[0])
        self.assertIn("public header", self.faults("top/a.cpp", '"gene_clocks/align.hpp"')[0])

    def test_public_headers_belong_to_their_layer(self):
        heights = {"neat/": 1, "protocol/": 0}
        text = "#include <gene_clocks/neat/agent.hpp>\n"
        self.assertEqual([], list(layers.faults("neat/src/agent.cpp", text, heights)))
        self.assertEqual(1, len(list(layers.faults("protocol/a.hpp", text, heights))))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
