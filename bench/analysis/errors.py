"""Errors of a method by its budget."""
import math
from statistics import median


def root_mean_square(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def rows_of(runs, truth):
    """A row for each budget and figure: the RMS of the relative errors, and the median of CPU seconds.

    runs: [(budget, {figure: (value, seconds)})], a run for each seed. truth: {figure: value}.
    """
    found = {}
    for budget, figures in runs:
        for figure, run in figures.items():
            if figure in truth:
                found.setdefault((figure, budget), []).append(run)
    return [{"figure": figure, "budget": budget, "seeds": len(of), "seconds": median(spent for _, spent in of),
             "error": root_mean_square([value / truth[figure] - 1 for value, _ in of])}
            for (figure, budget), of in found.items()]


def error_at(rows, seconds):
    """(error, CPU seconds) of one method at a time, between two budgets on lines through the logarithms.

    If all budgets take less, it is that of the largest. None if all take more.
    """
    rows = sorted((row["seconds"], row["error"]) for row in rows)
    for (t, error), (after, smaller) in zip(rows, rows[1:]):
        if t <= seconds < after:
            share = math.log(seconds / t) / math.log(after / t)
            return error ** (1 - share) * smaller ** share, seconds
    return (rows[-1][1], rows[-1][0]) if rows and rows[-1][0] <= seconds else None
