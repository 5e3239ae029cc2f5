"""How far a metric moved from what was accepted, and whether toward the truth: pure functions of numbers."""

import math
import struct
import sys
from dataclasses import dataclass

BITWISE, WITHIN, MOVED = "bitwise", "within", "moved"
TOWARD, AWAY, UNDECIDED = "toward", "away", "undecided"

# A spread of a few runs is smaller than what the next run may show; three of them are allowed.
SPREADS = 3.0
# What round-off alone may leave: a thousand units in the last place, as for observed orders.
ROUND_OFF = 1000.0 * sys.float_info.epsilon
# Nor does a move matter of which a million would not cross the band, or not double the number where there is no band: another start
# of an iteration that ends at the same root. But where a number is right to round-off behind a wide band, an error that grows more
# than a hundredfold is no round-off any more.
SHARE = 1e-6
GROWTH = 100.0
# A reference's uncertainty covers what lies within two standard uncertainties of it.
COVERAGE = 2.0


@dataclass(frozen=True)
class Change:
    kind: str                    # bitwise, within, moved
    direction: str | None        # of what moved: toward, away, undecided
    allowance: float             # how far it may move and still be within
    measured: bool               # whether the allowance rests on measured noise
    why: str = ""                # of an undecided direction


def same_bits(a, b):
    return struct.pack("<d", a) == struct.pack("<d", b)


def allowance(value, reference, unit, spread):
    """How far a metric may move without a cause: three measured spreads, and never less than round-off of its scale.

    The scale is the reference where there is one; an error of a pure number, whose reference is zero, is one of numbers of size
    1.
    """
    if reference:
        scale = max(abs(reference), abs(value))
    else:
        scale = max(1.0, abs(value)) if unit in ("1", "") else abs(value)
    return max(SPREADS * (spread or 0.0), ROUND_OFF * scale)


def _share(accepted, norm):
    """The part of a metric's band that no gate could ever see, as a number of the metric; of an error no more than it may grow by."""
    reference = abs(accepted.reference or 0.0)
    if accepted.band is None or not all(isinstance(end, (int, float)) and math.isfinite(end) for end in accepted.band):
        share = SHARE * max(reference, abs(accepted.value))
    else:
        share = SHARE * (accepted.band[1] - accepted.band[0]) * (reference if norm.split()[-1:] == ["relative"] else 1.0)
    # a value may meet its reference by chance; an error that is nought is one by design
    return min(share, GROWTH * abs(accepted.value)) if truth_of(accepted.reference, norm) == 0.0 else share


def truth_of(reference, norm):
    """The number that a metric would have without any error: its reference; zero where it is itself the norm of an error and no
    reference is stated; None where nobody says."""
    if reference is not None and math.isfinite(reference):
        return reference
    words = norm.split()
    return 0.0 if words[-1:] == ["value"] and len(words) > 1 else None


def change(value, accepted, norm, reference, uncertainty):
    """Change of a finite `value` from what was accepted (a baseline.Accepted with a value); ValueError for a number that is not
    finite: a gate asks isfinite first."""
    if not (math.isfinite(value) and math.isfinite(accepted.value)):
        raise ValueError("a change of numbers that are not finite")
    allowed = max(allowance(accepted.value, accepted.reference, accepted.unit, accepted.spread), _share(accepted, norm))
    measured = accepted.spread is not None
    new_truth, old_truth = truth_of(reference, norm), truth_of(accepted.reference, norm)
    if not _same_truth(new_truth, old_truth, accepted.reference_spread):
        return Change(MOVED, UNDECIDED, allowed, measured, "the reference itself changed")
    if same_bits(value, accepted.value):
        return Change(BITWISE, None, allowed, measured)
    if abs(value - accepted.value) <= allowed:
        return Change(WITHIN, None, allowed, measured)
    return Change(MOVED, *_direction(value, accepted.value, new_truth, old_truth, uncertainty, allowed, measured))


def _same_truth(new, old, spread):
    """Whether a reference is what it was, but for the noise that was measured of it and for round-off."""
    if new is None or old is None:
        return new is old
    return abs(new - old) <= max(SPREADS * (spread or 0.0), ROUND_OFF * max(abs(new), abs(old)))


def _direction(value, old, new_truth, old_truth, uncertainty, allowed, measured):
    if new_truth is None:
        return UNDECIDED, allowed, measured, "no reference says where the truth is"
    far, was_far = abs(value - new_truth), abs(old - old_truth)
    covered = COVERAGE * (uncertainty or 0.0)
    if covered > 0.0 and far <= covered and was_far <= covered:
        return UNDECIDED, allowed, measured, "the reference's uncertainty covers both"
    if abs(far - was_far) <= allowed:
        return UNDECIDED, allowed, measured, "as far from the truth as before, on the other side"
    return (TOWARD if far < was_far else AWAY), allowed, measured, ""
