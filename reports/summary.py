"""What the first page says before anyone scrolls: counts, families, the numbers nearest to their bands' ends, cost."""

from dataclasses import dataclass

from reports.results import CLASSES, VERDICTS

SHOWN_WORST = 5


@dataclass
class Summary:
    cases: dict       # verdict -> number of cases
    families: list    # (family, {verdict -> number of cases})
    metrics: dict     # verdict -> number of metrics, with reported and skipped
    green: dict       # class -> number of passed metrics
    worst: list       # (case, metric, margin), the one that uses most of its band first
    without_number: int   # gated metrics that produced no number, and so cannot be ranked in `worst`
    cost: dict

    @property
    def total(self):
        return sum(self.cases.values())

    @property
    def red(self):
        return self.cases["error"] + self.cases["fail"]

    @property
    def headline(self):
        """The run in one sentence."""
        n = self.total
        if n == 0:
            return "No case has a result."
        gaps = self.cases["known-gap"]
        tail = f", {gaps} known gap{'s' if gaps > 1 else ''}" if gaps else ""
        if self.red == 0:
            if not gaps:
                return f"All {n} cases pass." if n > 1 else "The one case passes."
            return f"{self.cases['pass']} of {n} cases pass{tail}."
        fails, errors = self.cases["fail"], self.cases["error"]
        of = f"of {n} case{'s' if n > 1 else ''}"
        first = f"{fails} {of} fail{'s' if fails == 1 else ''}" if fails else f"{errors} {of} ended as error"
        second = f", {errors} ended as error" if fails and errors else ""
        return first + second + tail.replace(",", ";") + "."


def count(items, keys):
    found = dict.fromkeys(keys, 0)
    for item in items:
        found[item] += 1
    return found


def summarise(run):
    cases = run.cases
    metrics = [(c, m, p) for c in cases for m, p in c.metrics]
    gated = [t for t in metrics if t[1]["verdict"] not in ("reported", "skipped")]
    ranked = sorted((t for t in gated if t[2] is not None and t[2].use is not None), key=lambda t: -t[2].use)
    names = sorted({c.family for c in cases})
    costs = [c.data["cost"] for c in cases if "cost" in c.data]
    wall = run.data.get("wall_s", run.data.get("cost", {}).get("wall_s") if isinstance(run.data.get("cost"), dict) else None)
    return Summary(
        cases=count((c.verdict for c in cases), VERDICTS),
        families=[(f, count((c.verdict for c in cases if c.family == f), VERDICTS)) for f in names],
        metrics=count((m["verdict"] for _, m, _ in metrics), (*VERDICTS, "skipped", "reported")),
        green=count((m["class"] for c, m, _ in metrics if m["verdict"] == "pass"), CLASSES),
        worst=ranked[:SHOWN_WORST], without_number=sum(1 for t in gated if t[2] is None or t[2].number is None),
        cost={
            "wall_s": wall if isinstance(wall, (int, float)) else None,
            "cases_wall_s": sum(c["wall_s"] for c in costs), "cpu_s": sum(c["cpu_s"] for c in costs),
            "steps": sum(c["steps"] for c in costs), "particles": max((c["particles"] for c in costs), default=0),
            "peak_rss_bytes": max((c["peak_rss_bytes"] for c in costs), default=0),
        })
