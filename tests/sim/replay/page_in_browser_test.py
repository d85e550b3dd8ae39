"""Uses the replay page as a reader does, in a headless Chromium:

    page_in_browser_test.py GENE_CLOCKS

GENE_CLOCKS is the program that writes the page. Where there is no Chromium, it says so and exits
with 77, which counts as skipped.
"""

import atexit
import csv
import functools
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from xml.etree import ElementTree

from browser import Browser, find_browser

GENE_CLOCKS = None
SKIPPED = 77
CYCLES, ROBOTS, EVERY = 8000, 40, 10


@functools.cache
def folder():
    path = Path(tempfile.mkdtemp(prefix="gene-clocks-replay-"))
    atexit.register(shutil.rmtree, path)
    return path


@functools.cache
def sample_page(task="navigation"):
    """The address of a page, and the rows of its genealogy."""
    page, table = folder() / f"{task}.html", folder() / f"{task}.csv"
    subprocess.run([GENE_CLOCKS, "replay", "--task", task, "--seed", "1", "--every", str(EVERY),
                    "--set", f"run.cycles={CYCLES}", "--set", f"world.robots={ROBOTS}",
                    "--set", "odneat.p_mutate=0.6", "--output", str(page), "--genealogy", str(table)],
                   check=True, stdout=subprocess.DEVNULL)
    with open(table, encoding="utf-8") as file:
        return page.as_uri(), list(csv.DictReader(file))


@functools.cache
def browser():
    started = Browser()
    atexit.register(started.close)
    return started


def pixels(png):
    """The pixels of a PNG of 8 bits a channel without interlace, as rows of tuples."""
    data, place, size = png.read_bytes(), 8, None
    packed = b""
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        place += 12 + length
    width, height, depth, colour = size
    assert depth == 8 and colour in (2, 6)
    channels = 3 if colour == 2 else 4
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * channels)
    for line in range(height):
        begin = line * (width * channels + 1)
        row = bytearray(raw[begin + 1:begin + 1 + width * channels])
        unfilter(raw[begin], row, above, channels)
        rows.append([tuple(row[i:i + 3]) for i in range(0, len(row), channels)])
        above = row
    return rows


def unfilter(kind, row, above, channels):
    for i in range(len(row)):
        left = row[i - channels] if i >= channels else 0
        corner = above[i - channels] if i >= channels else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + above[i]) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            guess = left + above[i] - corner
            nearest = min((left, above[i], corner), key=lambda value: abs(guess - value))
            row[i] = (row[i] + nearest) & 255


class PageTest(unittest.TestCase):
    address, genealogy = None, None

    def setUp(self):
        self.address, self.genealogy = sample_page()
        self.browser = browser()
        self.browser.open(f"{self.address}#cycle=0")

    def tearDown(self):
        self.browser.frame()
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([address.partition("#")[0] for address in self.browser.requests
                          if not address.startswith("data:,")], [self.address])

    def text(self, selector):
        return self.browser.evaluate(f"document.querySelector('{selector}').textContent")

    def cycle(self):
        return int(re.sub(r"\D", "", self.text("#now")))

    def picture_of(self, selector):
        """The pixels of an element as it is on the screen."""
        self.browser.frame()
        path = folder() / "screen.png"
        self.browser.screenshot(path, selector)
        return pixels(path)

    def count(self, picture, colour):
        wanted = tuple(int(colour[i:i + 2], 16) for i in (1, 3, 5))
        return sum(pixel == wanted for row in picture for pixel in row)

    def choose(self, row):
        self.browser.click_on(f"#genes li:nth-child({row + 1}) button")
        self.browser.frame()


class LoadedPageTest(PageTest):
    def test_says_what_it_shows(self):
        self.assertEqual(self.text("#title"), "Navigation with gene clocks")
        self.assertIn(f"{ROBOTS} robots", self.text("#lead"))
        self.assertIn(f"{len(self.genealogy)} are in the final swarm", self.text("#lead"))
        self.assertIn("Trajectory hash", self.text("#facts"))

    def test_draws_arena_and_curve(self):
        self.browser.open(f"{self.address}#colour=energy")
        arena = self.picture_of("#arena")
        self.assertGreater(self.count(arena, "#b9c0c9"), 4000)  # walls
        self.assertGreater(self.count(arena, "#3d86bd"), 10 * ROBOTS)  # all with half of the energy
        timeline = self.picture_of("#timeline")
        self.assertGreater(self.count(timeline, "#1b1f24"), 400)  # the curve
        self.assertGreater(self.count(timeline, "#0072b2"), 50)  # the first lineage

    def test_lists_the_genes_of_the_final_swarm(self):
        marks = self.browser.evaluate("[...document.querySelectorAll('#genes .mark')].map((e) => e.textContent)")
        counts = self.browser.evaluate("[...document.querySelectorAll('#genes .count')].map((e) => Number(e.textContent))")
        self.assertEqual(marks, [f"⟨{row['counter']}, {row['robot']}⟩" for row in self.genealogy])
        self.assertEqual(counts, [int(row["carriers"]) for row in self.genealogy])
        self.assertGreater(len(marks), 20)
        rows = self.browser.evaluate("document.querySelectorAll('#table tr').length")
        self.assertEqual(rows, len(self.genealogy))

    def test_the_list_can_be_searched(self):
        row = self.genealogy[-1]
        self.browser.click_on("#find")
        self.browser.send("Input.insertText", text=f"{row['counter']}, {row['robot']}")
        marks = self.browser.evaluate("[...document.querySelectorAll('#genes .mark')].map((e) => e.textContent)")
        self.assertIn(f"⟨{row['counter']}, {row['robot']}⟩", marks)
        self.assertLess(len(marks), 4)

    def test_the_genealogy_has_a_node_for_each_birth(self):
        births = {(row["created_by"], row["birth"]) for row in self.genealogy}
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#tree .node').length"), len(births))

    def test_every_control_has_a_name(self):
        tree = self.browser.send("Accessibility.getFullAXTree")["nodes"]
        roles = {"button", "combobox", "slider", "checkbox", "searchbox", "image", "img"}
        found = [node for node in tree if node.get("role", {}).get("value") in roles]
        self.assertGreater(len(found), 30)
        for node in found:
            self.assertTrue(node["name"].get("value"), node)


class TimeTest(PageTest):
    def test_the_slider_moves_the_time(self):
        before = self.picture_of("#arena")
        x, y = self.browser.middle_of("#slider")
        self.browser.click(x, y)
        self.browser.frame()
        self.assertAlmostEqual(self.cycle(), CYCLES / 2, delta=CYCLES / 50)
        self.assertTrue(self.picture_of("#arena") != before)

    def test_the_curve_can_be_dragged(self):
        x, y = self.browser.middle_of("#timeline")
        self.browser.drag((x, y), (x + 200, y))
        later = self.cycle()
        self.assertGreater(later, CYCLES / 2 + 500)
        self.browser.drag((x, y), (x - 5000, y))
        self.assertEqual(self.cycle(), 0)
        self.browser.drag((x, y), (x + 5000, y))
        self.assertEqual(self.cycle(), CYCLES)

    def test_keys_step_and_jump(self):
        for key, cycle in (("ArrowRight", EVERY), ("ArrowRight", 2 * EVERY), ("ArrowLeft", EVERY),
                           ("End", CYCLES), ("ArrowRight", CYCLES), ("Home", 0), ("ArrowLeft", 0)):
            self.browser.press(key)
            self.assertEqual(self.cycle(), cycle, key)
        self.browser.press("ArrowRight", shift=True)
        self.assertEqual(self.cycle(), 10 * EVERY)

    def test_plays_and_pauses(self):
        self.browser.press(" ", text=" ")
        self.browser.evaluate("new Promise((done) => { const look = () => "
                              "player.cycle > 30 ? done() : setTimeout(look, 10); look(); })")
        self.assertEqual(self.browser.evaluate("document.querySelector('#play').ariaLabel"), "Pause")
        self.browser.click_on("#play")
        stopped = self.cycle()
        self.browser.frame()
        self.assertEqual(self.cycle(), stopped)
        self.assertEqual(self.browser.evaluate("document.querySelector('#play').ariaLabel"), "Play")

    def test_playing_ends_with_the_run(self):
        self.browser.open(f"{self.address}#cycle={CYCLES - 5}")
        self.browser.click_on("#play")
        self.browser.evaluate("new Promise((done) => { const look = () => "
                              "player.isPlaying ? setTimeout(look, 10) : done(); look(); })")
        self.assertEqual(self.cycle(), CYCLES)

    def test_the_address_leads_back(self):
        self.choose(0)
        x, y = self.browser.middle_of("#timeline")
        self.browser.click(x, y)
        row = self.genealogy[0]
        address = self.browser.evaluate("location.href")
        self.assertEqual(address.partition("#")[2], f"cycle={self.cycle()}&gene={row['mark']}")
        cycle, chosen = self.cycle(), self.text("#chosen")
        self.browser.open(address)
        self.assertEqual(self.cycle(), cycle)
        self.assertEqual(self.text("#chosen"), chosen)

    def test_an_address_of_anything_does_no_harm(self):
        for rest in ("cycle=", "cycle=1e99", "cycle=-5", "cycle=x", "gene=1", "gene=@@", "robot=0",
                     "robot=1e9", "colour=none", "%", "cycle=%00&gene=<script>"):
            self.browser.open(f"{self.address}#{rest}")
            self.assertIn(self.cycle(), (0, CYCLES))


class GenesTest(PageTest):
    def test_carriers_light_up_as_many_as_there_are(self):
        self.browser.press("End")
        self.choose(0)
        row = self.genealogy[0]
        self.assertIn(f"Now in {row['carriers']} of {ROBOTS} robots", self.text("#chosen"))
        self.assertIn(f"by robot {row['created_by']}", self.text("#chosen"))
        self.assertIn(f"carries ⟨{row['counter']}, {row['robot']}⟩: {row['carriers']}", self.text("#legend"))
        many = self.count(self.picture_of("#arena"), "#d55e00")
        self.assertGreater(many, 15 * int(row["carriers"]))
        self.browser.click_on("#origin")
        self.assertEqual(self.cycle(), int(row["created_cycle"]) + 1)
        few = self.count(self.picture_of("#arena"), "#d55e00")
        self.assertGreater(few, 10)
        self.assertLess(few, many / 2)
        self.browser.press("Escape")
        self.assertEqual(self.count(self.picture_of("#arena"), "#d55e00"), 0)

    def test_keys_go_through_the_list(self):
        for key, row in (("n", 0), ("n", 1), ("p", 0), ("p", -1)):
            self.browser.press(key, text=key)
            self.assertIn(f"⟨{self.genealogy[row]['counter']}, {self.genealogy[row]['robot']}⟩", self.text("#chosen"))

    def test_a_robot_shows_its_genome(self):
        self.browser.press("End")
        self.browser.middle_of("#arena")
        x, y, left, top = self.browser.evaluate(
            "(() => { const r = document.querySelector('#arena').getBoundingClientRect();"
            " return [player.arena.places[0], player.arena.places[1], r.x, r.y]; })()")
        self.browser.mouse("mouseMoved", left + x, top + y)
        self.browser.frame()
        shown = self.text("#robot")
        self.assertRegex(shown, r"Number\d+Energy\d+Clock\d")
        robot = int(re.match(r"Number(\d+)", shown)[1])
        genes = self.browser.evaluate(
            f"player.recording.geneSets[player.recording.setOf({robot} - 1, {CYCLES})].map((g) => player.recording.mark(g))")
        chips = self.browser.evaluate("[...document.querySelectorAll('#robot .chips button')].map((e) => e.textContent)")
        self.assertEqual(chips, genes)
        self.browser.click(left + x, top + y)
        self.browser.mouse("mouseMoved", left - 5, top - 5)
        self.browser.frame()
        self.assertIn(f"Number{robot}, kept", self.text("#robot"))

    def test_a_node_of_the_genealogy_chooses_its_gene(self):
        self.browser.click_on("#tree .node .target")
        self.assertIn("created in cycle", self.text("#node"))
        self.assertIn("created in cycle", self.text("#chosen"))
        self.browser.evaluate("document.querySelector('#tree .node:last-of-type').focus()")
        self.browser.press("Enter", text="\r")
        self.assertIn("robots carry", self.text("#node"))

    def test_colours_can_be_chosen(self):
        self.browser.press("End")
        pictures = []
        for colour in ("lineage", "newest", "energy"):
            self.browser.evaluate(f"(() => {{ const c = document.querySelector('#colour'); c.value = '{colour}';"
                                  " c.dispatchEvent(new Event('change')); })()")
            pictures.append(self.picture_of("#arena"))
        self.assertTrue(pictures[0] != pictures[1])
        self.assertTrue(pictures[1] != pictures[2])

    def test_messages_can_be_switched_off(self):
        self.browser.press("End")
        shown = self.picture_of("#arena")
        self.browser.click_on("#messages")
        self.assertTrue(self.picture_of("#arena") != shown)


class OpeningTest(PageTest):
    def setUp(self):
        super().setUp()
        self.browser.open(self.address)

    def test_opens_on_the_end_with_the_most_carried_gene_lit(self):
        self.assertEqual(self.cycle(), CYCLES)
        most = max(int(row["carriers"]) for row in self.genealogy)
        self.assertIn(f"Now in {most} of {ROBOTS} robots", self.text("#chosen"))
        self.assertGreater(self.count(self.picture_of("#arena"), "#d55e00"), 15 * most)

    def test_a_link_shows_what_it_says_and_no_more(self):
        self.browser.open(f"{self.address}#cycle=100")
        self.assertEqual(self.cycle(), 100)
        self.assertIn("Choose a gene", self.text("#chosen"))

    def test_playing_begins_anew_at_the_end(self):
        self.browser.press(" ", text=" ")
        self.browser.evaluate("new Promise((done) => { const look = () => "
                              "player.isPlaying && player.cycle < 4000 ? done() : setTimeout(look, 10); look(); })")
        self.browser.press(" ", text=" ")


class RobotsByKeyboardTest(PageTest):
    def test_a_key_goes_through_the_robots(self):
        for shift, number in ((False, 1), (False, 2), (True, 1), (True, ROBOTS), (False, 1)):
            self.browser.press("R" if shift else "r", shift=shift)
            self.assertIn(f"Number{number}, kept", self.text("#robot"))
            self.assertEqual(self.browser.evaluate("document.querySelector('#robot-number').value"), str(number))
        self.browser.press("Escape")
        self.assertIn("Point at a robot", self.text("#robot"))

    def test_a_number_can_be_typed(self):
        self.browser.click_on("#robot-number")
        self.browser.send("Input.insertText", text=str(ROBOTS))
        self.assertIn(f"Number{ROBOTS}, kept", self.text("#robot"))
        self.browser.send("Input.insertText", text="0")  # there is no robot 400
        self.assertIn(f"Number{ROBOTS}, kept", self.text("#robot"))


class TakeAwayTest(PageTest):
    def saved(self, selector):
        """Clicks; the name and the text of the file that the page hands over."""
        self.browser.evaluate(
            "window.saved = new Promise((done) => { window.download = (blob, name) =>"
            " blob.arrayBuffer().then((bytes) => done([name, blob.type,"
            " String.fromCharCode(...new Uint8Array(bytes).slice(0, 100000))])); }); 0")
        self.browser.click_on(selector)
        return self.browser.evaluate("window.saved")

    def test_the_picture_as_svg(self):
        self.browser.press("r")
        name, kind, text = self.saved("#save-svg")
        self.assertEqual((name, kind), ("navigation-gene-clock-cycle-0.svg", "image/svg+xml"))
        picture = ElementTree.fromstring(text.encode("latin-1"))
        shapes = [node.get("d") for node in picture.iter("{http://www.w3.org/2000/svg}path")]
        diamonds = [path for path in shapes if path.endswith("Z") and path.count("L") == 3]
        self.assertEqual(len(set(diamonds)), ROBOTS)
        self.assertEqual(len(diamonds), 2 * ROBOTS)  # without new genes: filled, and outlined
        self.assertIn("1", [node.text for node in picture.iter("{http://www.w3.org/2000/svg}text")])
        walls = self.browser.evaluate("player.recording.arena.walls_px.length")
        group = picture.find("{http://www.w3.org/2000/svg}g")
        self.assertEqual(len(group.findall("{http://www.w3.org/2000/svg}path")), walls)

    def test_the_picture_as_png(self):
        name, kind, text = self.saved("#save-png")
        self.assertEqual((name, kind), ("navigation-gene-clock-cycle-0.png", "image/png"))
        self.assertTrue(text.startswith("\x89PNG"))

    def test_a_film(self):
        self.browser.open(f"{self.address}#cycle={CYCLES - 200}")
        name, kind, text = self.saved("#film")
        self.assertEqual((name, kind), (f"navigation-gene-clock-cycle-{CYCLES - 200}.webm", "video/webm"))
        self.assertTrue(text.startswith("\x1a\x45\xdf\xa3"))  # EBML, which WebM begins with
        self.assertGreater(len(text), 1000)
        self.assertEqual(self.cycle(), CYCLES)


class OtherScreensTest(PageTest):
    def test_a_phone_has_no_need_to_scroll_sideways(self):
        self.browser.open(f"{self.address}#cycle=0", width=360, height=740)
        self.assertEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 360)
        for part in (".arena", ".panel", ".time"):
            left, right = self.browser.evaluate(
                f"(() => {{ const r = document.querySelector('{part}').getBoundingClientRect();"
                " return [r.left, r.right]; })()")
            self.assertLessEqual(right, 360, part)
            self.assertGreater(right - left, 320, part)
        self.choose(0)
        self.assertIn("Now in", self.text("#chosen"))

    def test_dark_mode_is_dark(self):
        self.browser.open(self.address, dark=True)
        self.assertGreater(self.count(self.picture_of("#arena"), "#1b1f25"), 50000)

    def test_the_mode_can_change_while_the_page_is_open(self):
        self.browser.send("Emulation.setEmulatedMedia",
                          features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.assertGreater(self.count(self.picture_of("#arena"), "#1b1f25"), 50000)


class CollectionTest(PageTest):
    def setUp(self):
        self.address, self.genealogy = sample_page("collection")
        self.browser = browser()
        self.browser.open(f"{self.address}#cycle=0")

    def test_items_are_drawn(self):
        self.assertEqual(self.text("#title"), "Collection with gene clocks")
        self.assertGreater(self.count(self.picture_of("#arena"), "#d3d9c3"), 2000)


if __name__ == "__main__":
    if find_browser() is None:
        print("Skipped: there is no Chromium (Debian: chromium)")
        sys.exit(SKIPPED)
    GENE_CLOCKS = sys.argv[1]
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
