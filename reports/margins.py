"""How much of its band a number uses, and where in the band it lies: what a reader needs to see how close a gate was."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Margin:
    number: float | None      # what the band speaks about; None when the run gave none
    band: tuple               # (low, high); None for an open end
    use: float | None         # 0 best, 1 at an end of the band, above 1 outside; None where no scale is given
    inside: bool

    @property
    def place(self):
        """Where the number lies for the eye: 0 at the low end, 1 at the high end; None without a number."""
        low, high = self.band
        if self.number is None:
            return None
        if low is not None and high is not None:
            if high > low:
                return (self.number - low) / (high - low)
            return 0.5 if self.inside else math.copysign(9.0, self.number - low)
        if self.use is None:
            return 0.5 if self.inside else (-0.2 if low is not None else 1.2)
        return self.use if low is None else 1.0 - self.use


def margin(number, band):
    """Use of a band [low, high].

    A band with zero inside or at an end is one of an error: the use is the error over the end on its side. Any other closed band
    is one of a value: the use is the distance from its middle over its half-width. A half-open band measures against its one end.
    """
    low, high = band
    if number is None or not math.isfinite(number):
        return Margin(None, (low, high), None, False)
    inside = (low is None or low <= number) and (high is None or number <= high)
    return Margin(number, (low, high), _use(number, low, high, inside), inside)


def _use(x, low, high, inside):
    if low is not None and high is not None:
        if low <= 0.0 <= high:
            end = high if x > 0.0 else low
            if x == 0.0:
                return 0.0
            return abs(x / end) if end != 0.0 else math.inf
        half = 0.5 * (high - low)
        return abs(x - 0.5 * (low + high)) / half if half > 0.0 else (0.0 if inside else math.inf)
    if high is not None and high > 0.0:
        return max(x, 0.0) / high
    if low is not None and low > 0.0:
        return low / x if x > 0.0 else math.inf
    if high is not None and high < 0.0:
        return high / x if x < 0.0 else math.inf
    if low is not None and low < 0.0:
        return max(-x, 0.0) / -low
    return None
