"""Looks at a report from outside: page_test.py WRITE_SAMPLE_REPORT PAGE_PROGRAM

WRITE_SAMPLE_REPORT writes a report of made-up runs into a folder; PAGE_PROGRAM is the folder of
write_page.py. Reads the page as a browser would, with nothing of the program that wrote it.
"""

import atexit
import functools
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

WRITE_SAMPLE_REPORT, PAGE_PROGRAM = None, None
VOID = {"meta", "link", "br", "hr", "img", "input", "col"}


class Page(HTMLParser):
    """What is on a page: elements with their attributes, and the text inside <data>."""

    def __init__(self, text):
        super().__init__()
        self.elements = []
        self.open = []
        self.shown = []  # (data-path, value, text)
        self.text = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.elements.append((tag, attributes))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "data":
            self.shown.append([attributes["data-path"], attributes["value"], ""])

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes nothing at line {self.getpos()[0]}")

    def handle_data(self, text):
        self.text.append(text)
        if self.open and self.open[-1] == "data":
            self.shown[-1][2] += text

    def with_tag(self, *tags):
        return [attributes for tag, attributes in self.elements if tag in tags]


def resolve(data, path):
    for key in path.split("."):
        data = data[int(key)] if isinstance(data, list) else data[key]
    return data


@functools.cache
def sample_report(kind="paper"):
    """The folder of a report that all tests read and none changes."""
    folder = Path(tempfile.mkdtemp(prefix="gene-clocks-page-"))
    atexit.register(shutil.rmtree, folder)
    subprocess.run([WRITE_SAMPLE_REPORT, str(folder), kind], check=True)
    return folder


class AnyReport:
    """What holds of the report of every kind of study."""

    KIND = "paper"

    @classmethod
    def setUpClass(cls):
        cls.folder = sample_report(cls.KIND)
        cls.text = (cls.folder / "index.html").read_text(encoding="utf-8")
        cls.data = json.loads((cls.folder / "report.json").read_text(encoding="utf-8"))
        cls.page = Page(cls.text)

    def test_elements_are_closed(self):
        self.assertEqual(self.page.open, [])

    def test_needs_no_network_and_no_scripts(self):
        self.assertEqual(self.page.with_tag("script", "link", "iframe", "object", "embed", "img"), [])
        for tag, attributes in self.page.elements:
            for name, value in attributes.items():
                self.assertFalse(name.startswith("on"), f"<{tag} {name}>")
                if name in ("href", "src", "srcset", "xlink:href", "data", "action", "poster"):
                    self.assertNotRegex(value, r"^\s*([a-z][a-z0-9+.-]*:|//)", f"<{tag} {name}>")
        self.assertNotRegex(self.text, r"@import|url\((?!#)")
        for address in re.findall(r"[a-z]+://[^\s\"'<>)]*", self.text):
            self.assertEqual(address, "http://www.w3.org/2000/svg")  # a name, not a place
        policy = next(attributes["content"] for attributes in self.page.with_tag("meta")
                      if attributes.get("http-equiv") == "Content-Security-Policy")
        self.assertTrue(policy.startswith("default-src 'none'"))

    def test_identifiers_are_unique_and_references_lead_somewhere(self):
        identifiers = [attributes["id"] for _, attributes in self.page.elements if "id" in attributes]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        for tag, attributes in self.page.elements:
            for target in re.findall(r"url\(#([^)]+)\)", " ".join(map(str, attributes.values()))):
                self.assertIn(target, identifiers)
            for name in ("aria-labelledby", "href"):
                target = attributes.get(name, "")
                if name == "href" and not target.startswith("#"):
                    if target:
                        self.assertTrue((self.folder / target).is_file(), target)
                    continue
                if target:
                    self.assertIn(target.lstrip("#"), identifiers, f"<{tag} {name}>")

    def test_figures_are_there_on_the_page_and_as_files(self):
        svgs = self.page.with_tag("svg")
        files = sorted(path.relative_to(self.folder).as_posix()
                       for path in self.folder.glob("figures/**/*") if path.is_file())
        self.assertEqual(len(files), 2 * len(svgs))
        linked = [attributes["href"] for attributes in self.page.with_tag("a")
                  if attributes["href"].startswith("figures/")]
        self.assertEqual(sorted(linked), files)
        for attributes in svgs:
            self.assertEqual(attributes["role"], "img")
        for name in files:
            self.assertRegex(name, r"^figures/[A-Za-z0-9_/-]+\.(png|svg)$")
            content = (self.folder / name).read_bytes()
            if name.endswith(".png"):
                self.assertTrue(content.startswith(b"\x89PNG\r\n\x1a\n"))
                self.assertGreater(int.from_bytes(content[16:20], "big"), 1000)  # pixels wide
                self.assertLess(len(content), 300_000)
            else:
                self.assertEqual(ElementTree.fromstring(content).tag, "{http://www.w3.org/2000/svg}svg")
                self.assertNotRegex(content.decode(), r"<dc:date>|\d{4}-\d\d-\d\dT|<image")

    def test_figures_have_texts_for_those_who_do_not_see_them(self):
        titles = re.findall(r"<title id=\"([^\"]+)\">([^<]+)</title>", self.text)
        labelled = [attributes["aria-labelledby"] for attributes in self.page.with_tag("svg")]
        self.assertEqual([identifier for identifier, _ in titles], labelled)
        for _, title in titles:
            self.assertRegex(title, r"[Mm]edian [\d\u202f.]+")

    def test_every_contrast_is_shown_with_its_verdict(self):
        paths = {path for path, _, _ in self.page.shown}
        found = []
        for i, group in enumerate(self.data["groups"]):
            for kind in ("treatment_contrasts", "condition_contrasts"):
                for j, contrast in enumerate(group[kind]):
                    place = f"groups.{i}.{kind}.{j}"
                    for key in ("median", "shift", "effect", "difference_p_corrected",
                                "equivalence_p_corrected", "power_equivalence", "identical"):
                        self.assertIn(f"{place}.{key}", paths)
                    found.append(contrast["verdict"])
            for j, contrast in enumerate(group["paired_contrasts"]):
                keys = ["seeds", "difference", "identical"]
                if contrast["verdict"] != "identical":
                    keys += ["difference_p_corrected", "equivalence_p_corrected", "power_equivalence"]
                for key in keys:
                    self.assertIn(f"groups.{i}.paired_contrasts.{j}.{key}", paths)
                found.append(contrast["verdict"])
        self.assertEqual(re.findall(r"class=\"found-(\w+)\"", self.text), found)

    def test_every_arm_is_shown(self):
        paths = {path for path, _, _ in self.page.shown}
        for i, comparison in enumerate(self.data["comparisons"]):
            for j, _ in enumerate(comparison["arms"]):
                self.assertIn(f"comparisons.{i}.arms.{j}.measures.f_c.median", paths)
                self.assertIn(f"comparisons.{i}.arms.{j}.median_counters.births", paths)

    def test_numbers_are_those_of_the_data(self):
        self.assertGreater(len(self.page.shown), 15)
        for path, value, text in self.page.shown:
            number = resolve(self.data, path)
            self.assertEqual(float(value), float(number), path)
            if text == "< 0.001":
                self.assertLess(number, 0.001, path)
                continue
            plain = text.replace("\u202f", "").replace("\u2212", "-")
            decimals = len(plain.partition(".")[2])
            self.assertLessEqual(abs(float(plain) - number), 0.5000001 * 10.0 ** -decimals, path)


class PaperReportTest(AnyReport, unittest.TestCase):
    def test_every_exhibit_is_there(self):
        # Figures 3 to 11 as run; 3, 5, 7, 9 and 11 as printed, where only navigation was run.
        self.assertEqual(len(list(self.folder.glob("figures/as-*/*.png"))), 9 + 5)
        words = "".join(self.page.text)
        for number in range(3, 12):
            self.assertIn(f"Figure {number}. ", words)
        titles = re.findall(r"<title id=\"as-[^\"]+\">([^<]+)</title>", self.text)
        self.assertEqual(len(titles), 9 + 5)
        for title in titles:
            self.assertRegex(title, r"Gene Clocks.* median [\d\u202f.]+")
            self.assertRegex(title, r"Timestamps.* median [\d\u202f.]+")
        self.assertGreater(len(self.page.shown), 800)

    def test_every_measure_and_verdict_is_shown(self):
        paths = {path for path, _, _ in self.page.shown}
        for i, comparison in enumerate(self.data["comparisons"]):
            for j, exhibit in enumerate(comparison["exhibits"]):
                for k, entry in enumerate(exhibit["ranges"]):
                    place = f"comparisons.{i}.exhibits.{j}.ranges.{k}"
                    self.assertIn(f"{place}.lower", paths)
                    self.assertIn(f"{place}.ours", paths)
                    self.assertIsNotNone(entry["agrees"])
            for measure in comparison["tests"]:
                if measure in ("f_c", "f_b", "t_f", "f_a", "controller_size"):
                    for test in ("all", "halves"):
                        self.assertIn(f"comparisons.{i}.tests.{measure}.{test}.p_value", paths)
            self.assertIn(f"comparisons.{i}.trajectories.identical", paths)

    def test_verdicts_say_what_the_data_say(self):
        exhibits = [exhibit for comparison in self.data["comparisons"]
                    for exhibit in comparison["exhibits"]]
        entries = [entry for exhibit in exhibits for entry in exhibit["ranges"] + exhibit["tests"]]
        cells = re.findall(r"<td>(?:<b class=\"(?:yes|no)\">)?(agrees|differs|not judged)(?:</b>)?</td>",
                           self.text)
        words = {True: "agrees", False: "differs", None: "not judged"}
        expected = [words[entry["agrees"]] for entry in entries]
        self.assertEqual(sorted(cells), sorted(expected))
        self.assertIn("agrees", cells)
        self.assertIn("differs", cells)


class MarkingsReportTest(AnyReport, unittest.TestCase):
    KIND = "markings"

    def test_all_nine_sources_are_told_apart(self):
        for task in ("navigation", "collection"):
            text = re.search(f"<title id=\"{task}-mended-f_c-text\">([^<]+)</title>", self.text).group(1)
            for source in ("Gene Clocks", "Gene Clocks, no merge", "Timestamps", "Drifting timestamps",
                           "Random identifiers", "Global counter", "Congruence classes", "Content hash",
                           "Hybrid logical clocks"):
                self.assertIn(f" {source}: median ", text)
        svg = (self.folder / "figures/navigation-mended-f_c.svg").read_text(encoding="utf-8")
        self.assertEqual(len(set(re.findall(r"stroke: (#[0-9a-f]{6}); stroke-width: 2.2", svg))), 9)


class StudyReportTest(AnyReport, unittest.TestCase):
    KIND = "loss"

    def test_the_papers_exhibits_are_for_the_papers_settings(self):
        self.assertEqual(list(self.folder.glob("figures/as-*")), [])
        self.assertNotIn("Figure 3", "".join(self.page.text))


class DriftReportTest(AnyReport, unittest.TestCase):
    KIND = "drift"


class OperatorsReportTest(AnyReport, unittest.TestCase):
    KIND = "operators"


class ReadingsReportTest(AnyReport, unittest.TestCase):
    KIND = "readings"


class SingleArmReportTest(AnyReport, unittest.TestCase):
    KIND = "single"


class HostileReportTest(AnyReport, unittest.TestCase):
    KIND = "hostile"

    def test_names_are_text(self):
        words = "".join(self.page.text)
        for name in ("<script>alert('title')</script>", "<script>alert('arm')</script>",
                     "'\"><svg onload=alert(2)>", "{{ 7 * 7 }}&lt;", "{{ 7 * 7 }}</b>.toml",
                     "\"><img src=x onerror=alert(1)>"):
            self.assertIn(name, words)
        for tag, attributes in self.page.elements:  # svg is ours
            self.assertNotIn("onload", attributes, tag)


class PageProgramTest(unittest.TestCase):
    """write_page.py by itself, with data that are not what they should be."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="gene-clocks-page-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.output = self.folder / "report"

    def run_on(self, text):
        data = self.folder / "report.json"
        data.write_text(text, encoding="utf-8")
        return subprocess.run(
            [sys.executable, "-B", str(Path(PAGE_PROGRAM) / "write_page.py"), str(data), str(self.output)],
            capture_output=True, text=True, check=False)

    def assert_refused(self, text, words):
        result = self.run_on(text)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, words)
        self.assertNotIn("Traceback", result.stderr)
        left = list(self.output.rglob("*")) if self.output.exists() else []
        self.assertEqual(left, [])

    def test_data_that_are_none_are_refused(self):
        self.assert_refused("", "report.json: Expecting value")
        self.assert_refused("[]", "format 1")
        self.assert_refused('{"format": 2}', "format 1")
        self.assert_refused('{"format": 1}', "missing or misplaced.*sources")
        self.assert_refused('{"format": 1, "groups": [{}]}', "missing or misplaced")

    def test_data_that_lack_something_are_refused(self):
        whole = (sample_report() / "report.json").read_text(encoding="utf-8")
        lacking = json.loads(whole)
        del lacking["comparisons"][0]["arms"][1]["curves"]["species"]
        self.assert_refused(json.dumps(lacking), "species")
        lacking = json.loads(whole)
        del lacking["comparisons"][1:], lacking["groups"][1:]
        del lacking["provenance"]["cost"]  # not needed before the page's last section
        self.assert_refused(json.dumps(lacking), "cost")


if __name__ == "__main__":
    WRITE_SAMPLE_REPORT, PAGE_PROGRAM = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
