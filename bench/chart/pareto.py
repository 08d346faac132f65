"""Which methods are worth choosing: those that no other one beats."""

# Times are medians on a machine that may have other work: smaller relative differences are noise.
NOISE = 0.1
# The judge itself: it has no errors by definition, so it is drawn but does not compete.
JUDGE = "113 bits"
# A method that answers a smaller share of the rays does not compete.
WHOLE = 0.999
# Errors of a row. None: the row tells no distances, or a distance is infinite.
ERRORS = {
    "wrong rays": lambda row: row["wrong_ppm"],
    "distance, mm": lambda row: row["error_mm"]["p999"] if row["ends"] else None,
    "distance, ulp": lambda row: row["error_ulp"]["p999"] if row["ends"] else None,
}


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


def mark(rows, times):
    """Adds to rows of one mode and one choice of rays what a chart shows of them.

    `time`: in times of the default's, its own (`own_time`), else by `times`, {variant: time}. `errors`: by name.
    `whole` and `front`: the names of the errors by which it competes, and of those by which no other one beats it.
    """
    beside = next((row.get("ns_per_ray") for row in rows if row["variant"] == "default"), None)
    for row in rows:
        own = row.get("of_default") or (beside and row.get("ns_per_ray") and row["ns_per_ray"] / beside)
        row.update(time=own or times.get(row["variant"]), own_time=bool(own), whole=[], front=[],
                   errors={name: value(row) for name, value in ERRORS.items()})
    for name in ERRORS:
        drawn = {row["variant"]: row for row in rows if row["time"] and row["errors"][name] is not None}
        whole = {v for v in judged_on_all(drawn) if drawn[v]["answered_share"] >= WHOLE}
        for variant in whole:
            drawn[variant]["whole"].append(name)
        for variant in front({v: (drawn[v]["time"], drawn[v]["errors"][name]) for v in whole - {JUDGE}}):
            drawn[variant]["front"].append(name)


def mark_all(data):
    """mark() for all that a file of csgrt_chart has: `totals`, `families` and `results`."""
    times = {(t["mode"], t["variant"]): t.get("of_default") for t in data["totals"]}
    choices = {}
    for kind in ("totals", "families", "results"):
        for row in data[kind]:
            if "error" not in row and row["decided"]:
                choices.setdefault((kind, row["mode"], row["family"], row["workload"]), []).append(row)
    for (_, mode, _, _), rows in choices.items():
        mark(rows, {variant: time for (of, variant), time in times.items() if of == mode})


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
