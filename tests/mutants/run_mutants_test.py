"""Tries the mutants' tool on a project of one header and one test program."""

import pathlib
import shutil
import tempfile
import unittest
from dataclasses import replace

import faults
import plan
import run_mutants
from workshop import Failed, Step, Verdict, Workshop, digest

HEADER = """\
#pragma once
int sum(int first, int last);
"""
SOURCE = """\
#include "sum.hpp"
// Sums up.
static int twice(int x) { return x + x; }
constexpr int half(int x) { return x / 2; }
static_assert(half(4) == 2);
int sum(int first, int last) {
    int total = 0;
    for (int i = first; i <= last; ++i) total += i;
    return half(twice(total));
}
"""
TEST = """\
#include "sum.hpp"

#include <gtest/gtest.h>

TEST(Sum, OfNothingIsZero) { EXPECT_EQ(sum(1, 0), 0); }
TEST(Sum, AddsUp) { EXPECT_EQ(sum(1, 4), 10); }
"""
PROJECT = """\
cmake_minimum_required(VERSION 3.25)
project(Sum CXX)
enable_testing()
find_package(GTest REQUIRED)
add_executable(sum_test sum.cpp sum_test.cpp)
target_link_libraries(sum_test PRIVATE GTest::gtest_main)
add_test(NAME again.sum COMMAND sum_test --gtest_filter=Sum.*)
"""
UNIT = Step("unit", ("sum_test",))
AGAIN = Step("again", ("sum_test",), r"^again\.")


def fault(meaning, before, after, equivalent="", meant=""):
    return faults.Fault(f"sum.cpp/{meaning}", "sum.cpp", meaning, before, after, equivalent, meant)


class ListTest(unittest.TestCase):
    """Reading lists, and holding them against the sources."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "sum.cpp").write_text(SOURCE)

    def read(self, text, file=None):
        (self.root / "list").write_text(text)
        return faults.read(self.root / "list", file)

    def test_a_line_is_a_fault(self):
        (one,) = self.read("# a comment\n\nsum.cpp\tadds nothing\ttotal += i\ttotal += 0\n")
        self.assertEqual(one.name, "sum.cpp/adds-nothing")
        self.assertIn(b"total += 0;", one.mutant(self.root))
        self.assertEqual((self.root / "sum.cpp").read_text(), SOURCE)

    def test_a_list_about_one_file_names_functions(self):
        (one,) = self.read("gene_clocks_sum\tadds Nothing\ttotal += i\ttotal += 0\n", "sum.cpp")
        self.assertEqual((one.name, one.file), ("sum.cpp/sum-adds-nothing", "sum.cpp"))

    def test_a_fault_may_remove_lines(self):
        (one,) = self.read("sum.cpp\tno comment\t// Sums up.\\nstatic\tstatic\n")
        self.assertIn(b'hpp"\nstatic', one.mutant(self.root))

    def test_a_line_of_too_few_columns_is_refused(self):
        with self.assertRaisesRegex(faults.BrokenList, "list:2: 3 columns"):
            self.read("# a comment\nsum.cpp\tadds nothing\ttotal += i\n")

    def assert_does_not_fit(self, line, words):
        with self.assertRaisesRegex(faults.BrokenList, words):
            faults.check(self.read(line), self.root)

    def test_a_text_that_is_not_there_is_an_error(self):
        self.assert_does_not_fit("sum.cpp\tx\ttotal -= i\ttotal += 0\n", "sum.cpp 0 times")

    def test_a_text_that_is_there_twice_is_an_error(self):
        self.assert_does_not_fit("sum.cpp\tx\ttotal\tsum\n", "sum.cpp 3 times")

    def test_a_file_that_is_not_there_is_an_error(self):
        self.assert_does_not_fit("product.hpp\tx\ttotal\tsum\n", "product.hpp: No such file")

    def test_a_name_that_is_there_twice_is_an_error(self):
        line = "sum.cpp\tadds nothing\ttotal += i\ttotal += 0\n"
        self.assert_does_not_fit(line + line, "two of that name")

    def test_a_line_may_say_which_test_is_meant_to_notice(self):
        (self.root / "tests").mkdir()
        (self.root / "tests/sum_test.cpp").write_text(TEST)
        line = "sum.cpp\tadds nothing\ttotal += i\ttotal += 0\t\t"
        (one,) = self.read(line + "sum AddsUp\n")
        self.assertEqual((one.equivalent, one.meant), ("", "sum AddsUp"))
        faults.check([one], self.root)
        faults.check(self.read(line + "goldens\n"), self.root)
        self.assert_does_not_fit(line + "sum Adds\n", "tests/sum_test.cpp has no test Adds")
        self.assert_does_not_fit(line + "product AddsUp\n", "there is no tests/product_test.cpp")

    def test_faults_are_chosen_by_the_beginning_of_their_names(self):
        one, other = fault("one", "1", "2"), fault("other", "1", "2", "no matter")
        self.assertEqual(run_mutants.choose([one, other], []), [one])
        self.assertEqual(run_mutants.choose([one, other], ["sum.cpp/oth"]), [other])
        self.assertEqual(run_mutants.choose([one, other], ["sum"]), [one, other])
        with self.assertRaisesRegex(faults.BrokenList, "did you mean 'sum.cpp/other'"):
            run_mutants.choose([one, other], ["sum.cpp/ohter"])


class OurListTest(unittest.TestCase):
    """The list of this project."""

    def test_fits_the_sources_and_every_fault_has_tests(self):
        everything = run_mutants.every_fault()
        self.assertGreater(len(everything), 60)
        for one in everything:
            steps = plan.steps_for(one)
            self.assertTrue(steps[0].is_meant, one.name)
            self.assertFalse(any(step.is_meant for step in steps[1:]), one.name)

    def test_what_the_list_says_is_tried_first_and_the_goldens_last(self):
        place = "neat/src/agent.cpp"
        one, other, last = (
            plan.steps_for(faults.Fault(f"agent.cpp/{meant}", place, "", "", "", "", meant))
            for meant in ("sim/core/messages CarryTheEnergyOfTheirSender", "", "goldens"))
        self.assertEqual(one[0].targets, ("tests/sim/core/messages_test",))
        self.assertEqual(one[0].only, "CarryTheEnergyOfTheirSender")
        self.assertEqual((one[0].link, one[-1]), ("unit", plan.GOLDENS))
        self.assertEqual((other[0].targets, other[0].only), (("tests/neat/agent_test",), ""))
        self.assertEqual(last[0], replace(plan.GOLDENS, is_meant=True))


class TrialTest(unittest.TestCase):
    """Mutants of a small project, which is built and tested."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.root = cls.folder / "root"
        cls.root.mkdir()
        (cls.root / "sum.hpp").write_text(HEADER)
        (cls.root / "sum.cpp").write_text(SOURCE)
        (cls.root / "sum_test.cpp").write_text(TEST)
        (cls.root / "CMakeLists.txt").write_text(PROJECT)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.said = []
        self.record = run_mutants.Record(self.folder / "work/record.json", self.id())

    def try_all(self, *chosen, steps=(UNIT,), say=None):
        before = digest(self.root)
        workshop = Workshop(self.root, self.folder / "work", shortest_limit_s=5.0)
        try:
            run_mutants.try_all(
                chosen, workshop,
                lambda fault: list(steps(fault.name) if callable(steps) else steps), self.record,
                say or self.said.append)
        finally:
            self.assertEqual(digest(self.root), before, "the sources themselves were changed")
        return [self.record.verdicts[one.name] for one in chosen]

    def reported(self, *chosen):
        good = run_mutants.report(chosen, self.record.verdicts, self.said.append)
        return good, "\n".join(self.said)

    def test_the_first_test_that_fails_is_named(self):
        chosen = [fault("adds nothing", "total += i", "total += 0")]
        self.assertEqual(self.try_all(*chosen), [Verdict("killed", "unit", "Sum.AddsUp")])
        good, text = self.reported(*chosen)
        self.assertTrue(good)
        self.assertIn("1 of 1 mutants killed", text)

    def test_only_the_test_that_is_meant_to_notice_counts_as_such(self):
        chosen = [fault("adds nothing", "total += i", "total += 0", meant="sum AddsUp"),
                  fault("adds twice", "total += i", "total += 2 * i", meant="sum OfNothingIsZero")]
        steps = {one.name: [Step("unit", ("sum_test",), only=one.meant.split()[1], is_meant=True), UNIT]
                 for one in chosen}
        self.assertEqual(self.try_all(*chosen, steps=steps.__getitem__),
                         [Verdict("killed", "unit", "Sum.AddsUp", True),
                          Verdict("killed", "unit", "Sum.AddsUp", False)])
        good, text = self.reported(*chosen)
        self.assertFalse(good)
        self.assertIn("noticed by Sum.AddsUp, not by sum OfNothingIsZero: sum.cpp/adds twice", text)
        self.assertIn("1 mutants noticed by the test that is meant to\n2 of 2 mutants killed", text)
        self.assertTrue(self.reported(chosen[0])[0])

    def test_what_only_the_goldens_notice_is_no_success_unless_the_list_says_so(self):
        goldens = replace(AGAIN, link=faults.GOLDENS)
        quiet = Step("unit", ("sum_test",), only="OfNothingIsZero", is_meant=True)
        chosen = [fault("adds nothing", "total += i", "total += 0")]
        (verdict,) = self.try_all(*chosen, steps=[quiet, goldens])
        self.assertEqual(verdict, Verdict("killed", "goldens", "again.sum (Failed)", False))
        good, text = self.reported(*chosen)
        self.assertFalse(good)
        self.assertIn("noticed by the golden trajectories alone: sum.cpp/adds nothing", text)
        meant = [replace(chosen[0], name="sum.cpp/meant", meant=faults.GOLDENS)]
        self.try_all(*meant, steps=[replace(goldens, is_meant=True)])
        good, text = self.reported(*meant)
        self.assertTrue(good)
        self.assertIn("1 of them by the golden trajectories, which alone can", text)

    def test_another_test_than_the_files_is_told(self):
        chosen = [fault("adds nothing", "total += i", "total += 0")]
        self.try_all(*chosen)
        good, text = self.reported(*chosen)
        self.assertTrue(good)
        self.assertIn("another than its file's tests: sum.cpp/adds nothing: Sum.AddsUp", text)

    def test_a_test_that_is_meant_must_be_there(self):
        with self.assertRaisesRegex(Failed, "sum_test has no test Adds"):
            self.try_all(fault("adds nothing", "total += i", "total += 0"),
                         steps=[Step("unit", ("sum_test",), only="Adds", is_meant=True)])

    def test_a_test_of_ctest_is_named(self):
        (verdict,) = self.try_all(fault("adds nothing", "total += i", "total += 0"), steps=[AGAIN])
        self.assertEqual(verdict, Verdict("killed", "again", "again.sum (Failed)"))

    def test_a_fault_that_changes_nothing_survives_and_is_no_success(self):
        chosen = [fault("comment", "Sums up.", "Adds up."),
                  fault("the same", "x + x", "2 * x"),
                  fault("adds nothing", "total += i", "total += 0")]
        verdicts = self.try_all(*chosen, steps=[UNIT, AGAIN])
        self.assertEqual([v.outcome for v in verdicts], ["survived", "survived", "killed"])
        good, text = self.reported(*chosen)
        self.assertFalse(good)
        self.assertIn("survived: sum.cpp/comment", text)
        self.assertIn("survived: sum.cpp/the same", text)
        self.assertIn("1 of 3 mutants killed", text)

    def test_an_equivalent_mutant_must_survive(self):
        chosen = [fault("comment", "Sums up.", "Adds up.", "a comment"),
                  fault("adds nothing", "total += i", "total += 0", "it only seems so")]
        self.try_all(*chosen)
        good, text = self.reported(*chosen)
        self.assertFalse(good)
        self.assertIn("not equivalent, though the list says so: sum.cpp/adds nothing", text)
        self.assertNotIn("comment", text.split("mutants killed")[0].split("not equivalent")[1])

    def test_what_an_assertion_refuses_at_compile_time_is_killed_by_the_compiler(self):
        (verdict,) = self.try_all(fault("a third", "x / 2", "x / 3"))
        self.assertEqual((verdict.outcome, verdict.link), ("killed", "compiler"))
        self.assertRegex(verdict.by, "^sum.cpp:5:.* static assertion failed$")

    def test_what_is_no_program_is_senseless_and_no_success(self):
        chosen = [fault("nonsense", "int total = 0;", "int total = nought;")]
        (verdict,) = self.try_all(*chosen)
        self.assertEqual(verdict.outcome, "senseless")
        self.assertFalse(self.reported(*chosen)[0])

    def test_a_mutant_that_crashes_or_hangs_is_killed(self):
        verdicts = self.try_all(
            fault("crashes", "int total = 0;", "int total = first < last ? *(volatile int*)nullptr : 0;"),
            fault("hangs", "int total = 0;", "int total = 0;\\n    for (volatile int* end = &last; *end > 3;) {}"))
        self.assertEqual(verdicts, [Verdict("killed", "unit", "Sum.AddsUp (SIGSEGV)"),
                                    Verdict("killed", "unit", "Sum.AddsUp (hangs)")])

    def test_the_sources_must_pass_without_a_fault(self):
        test = self.root / "sum_test.cpp"
        self.addCleanup(test.write_text, TEST)
        test.write_text(TEST.replace("10", "11"))
        with self.assertRaisesRegex(Failed, "without a fault, too, a test fails: Sum.AddsUp"):
            self.try_all(fault("adds nothing", "total += i", "total += 0"))
        test.write_text(TEST.replace("10", "ten"))
        with self.assertRaisesRegex(Failed, "the sources do not build"):
            self.try_all(fault("adds nothing", "total += i", "total += 0"))

    def test_a_run_that_was_interrupted_goes_on_and_leaves_no_fault_behind(self):
        chosen = [fault("adds nothing", "total += i", "total += 0"),
                  fault("adds twice", "total += i", "total += 2 * i")]

        def interrupt(text):
            if text.startswith("[  1/2"):
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.try_all(*chosen, say=interrupt)
        self.assertEqual((self.folder / "work/source/sum.cpp").read_text(), SOURCE)
        self.record = run_mutants.Record(self.record.path, self.record.key)
        self.assertEqual(list(self.record.verdicts), [chosen[0].name])
        self.assertEqual([v.outcome for v in self.try_all(*chosen)], ["killed", "killed"])
        tried = [text for text in self.said if text.startswith("[")]
        self.assertEqual(len(tried), 1, "the first fault was tried again")
        self.assertEqual(run_mutants.Record(self.record.path, "other sources").verdicts, {})

    def test_a_fault_left_in_the_copy_is_mended(self):
        chosen = [fault("comment", "Sums up.", "Adds up.")]
        self.try_all(*chosen)
        copy = self.folder / "work/source/sum.cpp"
        copy.write_text(SOURCE.replace("total += i", "total += 0"))
        (copy.parent / "left_over.hpp").write_text("")
        self.record = run_mutants.Record(self.record.path, "again")
        self.assertEqual(self.try_all(*chosen), [Verdict("survived")])
        self.assertFalse((copy.parent / "left_over.hpp").exists())

    def test_two_runs_do_not_share_a_folder(self):
        workshop = Workshop(self.root, self.folder / "work")
        with workshop.locked(), self.assertRaisesRegex(Failed, "another run is at work"):
            self.try_all(fault("comment", "Sums up.", "Adds up."))


if __name__ == "__main__":
    unittest.main()
