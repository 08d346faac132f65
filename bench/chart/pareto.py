"""Which methods are worth choosing: those that no other one beats."""

# Times are medians on a machine that may have other work: smaller relative differences are noise.
NOISE = 0.1


def dominates(a, b, noise=NOISE):
    """Whether `a` makes `b` pointless. Each is (time, error, error, ...), less is better.

    No error of `a` is larger. And one is smaller while `a` is at most slower by noise, or `a` is faster by more than
    noise.
    """
    if any(x > y for x, y in zip(a[1:], b[1:])):
        return False
    if a[1:] != b[1:]:
        return a[0] <= b[0] * (1 + noise)
    return a[0] * (1 + noise) < b[0]


def front(points, noise=NOISE):
    """The names of those of `points`, {name: (time, error, ...)}, that none of the others dominates."""
    return {name for name, point in points.items()
            if not any(dominates(other, point, noise) for key, other in points.items() if key != name)}


def judged_on_all(totals):
    """The names of those of `totals`, {name: {"rays": ...}}, that were judged on the most rays.

    Errors of the others come from another sample of rays and cannot be compared.
    """
    most = max((t["rays"] for t in totals.values()), default=0)
    return {name for name, t in totals.items() if t["rays"] == most}
