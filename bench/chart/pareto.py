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
    """The names of those of `points`, {name: (time, error, ...)}, that no other one on the front dominates.

    From the most exact one on: a chain of methods, each a little faster and less exact than the one before, must not
    lead away from its own end.
    """
    chosen = []
    for name in sorted(points, key=lambda name: (points[name][1:], points[name][0])):
        if not any(dominates(points[other], points[name], noise) for other in chosen):
            chosen.append(name)
    return set(chosen)


def judged_on_all(totals):
    """The names of those of `totals`, {name: {"rays": ...}}, that were judged on the most rays.

    Errors of the others come from another sample of rays and cannot be compared.
    """
    most = max((t["rays"] for t in totals.values()), default=0)
    return {name for name, t in totals.items() if t["rays"] == most}


def beaten_at(results, noise=NOISE):
    """Where another method beats the default: (workload, method, its share of the default's time), one a workload.

    `results` are rows of one mode. The other has answered all rays, is wrong on no more of them, has distance errors at
    most twice as large, is faster by more than noise, and the intervals of the two times do not meet.
    """
    def far_off(row):
        return row["error_mm"]["p999"]

    beaten = []
    for default in results:
        if default["variant"] != "default" or not default.get("ns_per_ray"):
            continue
        rivals = [r for r in results
                  if r["workload"] == default["workload"] and r is not default and r.get("ns_per_ray")
                  and not r.get("outside")  # it was timed elsewhere
                  and r["decided"] >= default["decided"] and r["wrong"] <= default["wrong"]
                  and far_off(r) is not None and far_off(r) <= 2 * far_off(default)
                  and r["ns_per_ray"] * (1 + noise) < default["ns_per_ray"]
                  and r["ns_per_ray_interval"][1] < default["ns_per_ray_interval"][0]]
        if rivals:
            best = min(rivals, key=lambda r: r["ns_per_ray"])
            beaten.append((default["workload"], best["variant"], best["ns_per_ray"] / default["ns_per_ray"]))
    return beaten
