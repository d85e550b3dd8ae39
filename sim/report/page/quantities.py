"""What is drawn of an arm besides curves: f_c and the measures of chronology."""

from dataclasses import dataclass

import wording


@dataclass(frozen=True)
class Quantity:
    """A number that every arm has, with its spread over the runs."""

    key: str  # in report.json
    title: str
    unit: str
    scale: float = 1.0  # from report.json to the unit

    def of(self, arm):
        """(lower quartile, median, upper quartile) in the unit; none where no run has it."""
        place = "measures" if self.key in wording.MEASURES else "chronology"
        summary = arm.numbers[place][self.key]
        if summary is None:
            return None
        return tuple(self.scale * summary[key]
                     for key in ("lower_quartile", "median", "upper_quartile"))

    def median(self, arm):
        spread = self.of(arm)
        return None if spread is None else spread[1]

    def text(self, arm):
        """In words, for those who do not see the figure."""
        median = self.median(arm)
        shown = "none" if median is None else f"median {wording.significant(median)} {self.unit}"
        return f"{self.title.lower()}: {shown}"


FITNESS = Quantity("f_c", "Average accumulated swarm fitness $f_c$", "energy")

CAUSE = Quantity("cause_inverted", "Sorted against cause", "% of pairs", 100)
TIME = Quantity("time_inverted", "Sorted against time", "% of pairs", 100)
GENOME = Quantity("genome_inverted", "Against time in a genome", "% of pairs", 100)
SAME = Quantity("same_collisions", "Mark of the same innovation", "% of genes", 100)
DIFFERENT = Quantity("different_collisions", "Mark of another innovation", "% of genes", 100)
MISSED = Quantity("missed_homologies", "Missed homologies", "per alignment")
FALSE = Quantity("false_homologies", "False homologies", "per alignment")
STAMP = Quantity("stamp_bytes", "Bytes of the clock", "per message")

CHRONOLOGY = (CAUSE, TIME, GENOME, SAME, DIFFERENT, MISSED, FALSE, STAMP)


def present(quantities, arms):
    """Those that are other than zero somewhere."""
    return [quantity for quantity in quantities
            if any(quantity.median(arm) for arm in arms)]
