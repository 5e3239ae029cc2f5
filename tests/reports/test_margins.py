"""Use of a band, against values worked out by hand."""

import math

import pytest

from reports.margins import margin


@pytest.mark.parametrize("number, band, use, inside", [
    (0.0, (-0.03, 0.03), 0.0, True), (0.015, (-0.03, 0.03), 0.5, True), (-0.06, (-0.03, 0.03), 2.0, False),
    (0.015, (-0.01, 0.03), 0.5, True), (-0.005, (-0.01, 0.03), 0.5, True),
    (2e-11, (0.0, 1e-10), 0.2, True), (3e-10, (0.0, 1e-10), 3.0, False), (-1e-30, (0.0, 1e-10), math.inf, False),
    (2.0, (1.7, 2.3), 0.0, True), (2.3, (1.7, 2.3), 1.0, True), (1.4, (1.7, 2.3), 2.0, False),
    (0.25, (None, 0.5), 0.5, True), (-7.0, (None, 0.5), 0.0, True), (4.0, (2.0, None), 0.5, True), (1.0, (2.0, None), 2.0, False),
    (5.0, (5.0, 5.0), 0.0, True), (0.1, (0.0, None), None, True), (-0.1, (0.0, None), None, False)])
def test_use(number, band, use, inside):
    found = margin(number, band)
    assert found.inside is inside
    assert found.use == (use if use is None or math.isinf(use) else pytest.approx(use))


@pytest.mark.parametrize("number", [None, math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_never_inside(number):
    found = margin(number, (None, 1.0))
    assert (found.number, found.use, found.inside, found.place) == (None, None, False, None)


@pytest.mark.parametrize("number, band, place", [(1.7, (1.7, 2.3), 0.0), (2.3, (1.7, 2.3), 1.0), (2.9, (1.7, 2.3), 2.0),
                                                 (0.0, (0.0, 1.0), 0.0)])
def test_place(number, band, place):
    assert margin(number, band).place == pytest.approx(place)
