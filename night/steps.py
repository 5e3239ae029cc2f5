"""Steps of a series: the piecewise constant fit with the least penalised squares.

Of all ways to cut x_1 .. x_n into segments, the one with the least sum over segments of sum (x - mean)^2 / sigma^2, plus a
penalty for each cut: Jackson et al., An algorithm for optimal partitioning of data on an interval, IEEE Signal Processing Letters
12 (2005) 105. The penalty is twice that of the Bayesian information criterion for place and height of a cut, 2 log n: of a
hundred series of pure noise one or two show a step. sigma comes from first differences by their median (steps are few and do not
count in it), and is never taken below `floor`: numbers that a program computes without noise are equal until somebody changes the
program.
"""

import math
import statistics
from dataclasses import dataclass


@dataclass(frozen=True)
class Step:
    index: int       # of the first value after the step
    before: float    # mean of the segment before
    after: float     # mean of the segment after


def scatter(x):
    """Standard deviation about a level that has few steps: of first differences, by their median."""
    if len(x) < 3:
        return 0.0
    return statistics.median_low(abs(b - a) for a, b in zip(x, x[1:])) / (0.6744897501960817 * math.sqrt(2.0))


def _misfits(z):
    """misfit[a][b] = sum over a <= i < b of (z_i - mean)^2, by Welford's recurrence: no difference of large sums, for z may be
    huge."""
    n = len(z)
    misfit = [[0.0] * (n + 1) for _ in range(n)]
    for a in range(n):
        mean = squares = 0.0
        for b in range(a, n):
            away = z[b] - mean
            mean += away / (b - a + 1)
            squares += away * (z[b] - mean)
            misfit[a][b + 1] = squares
    return misfit


def without_spikes(x):
    """Each value replaced by the median of itself and its neighbours (at an end, of the three there): a single spike goes, a step
    stays where it is."""
    if len(x) < 3:
        return list(x)
    middle = [statistics.median(x[i - 1:i + 2]) for i in range(1, len(x) - 1)]
    return [statistics.median(x[:3]), *middle, statistics.median(x[-3:])]


def steps(x, floor, shortest=1):
    """Steps of the values x. `floor` > 0: the least standard deviation that a value may be thought to have. `shortest`: values
    that a segment must have; with more than one, single spikes are taken out first."""
    n = len(x)
    if n < 2 * shortest:
        return []
    if not all(math.isfinite(v) for v in x) or not floor > 0.0:
        raise ValueError("steps of numbers that are not finite, or a floor that is not above zero")
    scale = max(scatter(x), floor)
    if shortest > 1:
        x = without_spikes(x)
    if min(x) == max(x):
        return []
    misfit = _misfits([(v - x[0]) / scale for v in x])
    penalty = 4.0 * math.log(max(n, 8))
    best, cut = [-penalty] + [math.inf] * n, [0] * (n + 1)
    for b in range(shortest, n + 1):
        for a in [0, *range(shortest, b - shortest + 1)]:
            cost = best[a] + misfit[a][b] + penalty
            if cost < best[b] - 1e-9 * abs(cost):
                best[b], cut[b] = cost, a
    edges, b = [n], n
    while b > 0:
        b = cut[b]
        edges.append(b)
    edges.reverse()
    means = [statistics.fmean(x[a:b]) for a, b in zip(edges, edges[1:])]
    return [Step(edge, means[i], means[i + 1]) for i, edge in enumerate(edges[1:-1])]
