"""Numbers as they are printed."""

import pytest

from reports import numbers


@pytest.mark.parametrize("x, text", [
    (0.0, "0"), (1.0, "1"), (16.3, "16.3"), (16.21049, "16.21"), (0.0056, "0.0056"), (1.3e-12, "1.3e−12"), (-2.5e-7, "−2.5e−7"),
    (123456.0, "1.235e5"),
    (99999.0, "99999"), (4096, "4096"), (1200000, "1\u202f200\u202f000"), (-3, "−3"), (None, "–"), (float("nan"), "nan"),
    (float("-inf"), "−inf"),
    (0.99999, "1"), (1e-4, "0.0001"), (True, "yes")])
def test_number(x, text):
    assert numbers.number(x) == text


@pytest.mark.parametrize("value, uncertainty, text", [
    (16.21, 0.1, "16.21 ± 0.10"), (1000.0, 1.0, "1000.0 ± 1.0"), (2.0, 0.0, "2"), (2.0, None, "2"),
    (-0.5, 0.02, "−0.500 ± 0.020"),
    (1.2e9, 3e7, "1.2e9 ± 3e7"), (None, 0.1, "–")])
def test_with_uncertainty(value, uncertainty, text):
    assert numbers.with_uncertainty(value, uncertainty) == text


@pytest.mark.parametrize("text, shown", [("1", ""), ("mm", "mm"), ("kg/m^3", "kg/m³"), ("s^-1", "s⁻¹"), ("um", "µm"),
                                         ("deg", "°"), ("N*m", "N·m")])
def test_unit(text, shown):
    assert numbers.unit(text) == shown


@pytest.mark.parametrize("text, shown", [
    ("L_f", "<i>L<sub>f</sub></i>"), ("rho_0", "<i>ρ<sub>0</sub></i>"), ("h/dx", "<i>h/Δx</i>"),
    ("V x dW/dx", "<i>V x dW/dx</i>"), ("int x^2 W dV", "<i>∫ x<sup>2</sup> W dV</i>"),
    ("W' - W'_ref", "<i>W′ − W′<sub>ref</sub></i>"), ("a < b & c", "<i>a &lt; b &amp; c</i>"),
    ("sigma_{xx}", "<i>σ<sub>xx</sub></i>"),
    ("<b>", "<i>⟨b⟩</i>"), ("max |W|", "<i><b>max</b> |W|</i>")])
def test_symbol(text, shown):
    assert str(numbers.symbol(text)) == shown


@pytest.mark.parametrize("text, shown", [
    ("W h^d", "W hᵈ"), ("dW/dr h^(d+1)", "dW/dr h⁽ᵈ⁺¹⁾"), ("h/dx", "h/Δx"), ("V x dW/dx", "V x dW/dx"), ("int f dx", "∫ f dx"),
    ("c_0", "c₀"),
    ("the sum of forces", "the sum of forces"), ("|sum V x grad W - I|", "|\u2211 V x ∇ W − I|"), ("Linf", "L∞"),
    ("10^-3 s", "10⁻³ s"),
    ("cubic_spline", "cubic_spline"), ("wall-time", "wall-time"), ("the body's", "the body's"),
    ("(1/2) <x^2> f''", "(1/2) ⟨x²⟩ f′′")])
def test_label(text, shown):
    assert numbers.label(text) == shown


@pytest.mark.parametrize("text, shown", [
    ("sigma_xy = 2 h^2", "σ<sub>xy</sub> = 2 h<sup>2</sup>"), ("<script>x</script>", "&lt;script&gt;x&lt;/script&gt;"),
    ("a^{<b>}", "a<sup>⟨b⟩</sup>"), ("|<grad f> - grad f|", "|⟨∇ f⟩ − ∇ f|"), ("L2 relative", "L₂ relative")])
def test_prose(text, shown):
    assert numbers.prose(text) == shown


def test_words():
    assert numbers.words("gradient_l2") == "gradient L₂"


@pytest.mark.parametrize("fraction, text", [
    (0.0, "0\u202f%"), (0.0001, "< 0.1\u202f%"), (0.034, "3.4\u202f%"), (0.34, "34\u202f%"), (2.4, "240\u202f%"),
    (240.0, "240\u202f×"), (None, "–")])
def test_percent(fraction, text):
    assert numbers.percent(fraction) == text


@pytest.mark.parametrize("seconds, text", [(0.0001, "< 1 ms"), (0.42, "420 ms"), (3.21, "3.2 s"), (14.2, "14 s"),
                                           (192.0, "3 min 12 s"), (3840.0, "1 h 04 min")])
def test_duration(seconds, text):
    assert numbers.duration(seconds) == text


@pytest.mark.parametrize("ends, text", [([-0.03, 0.03], "± 0.03"), ([0, 1e-10], "0 … 1e−10"), ([1.7, None], "≥ 1.7"),
                                        ([None, 2], "≤ 2"), ([0, 0], "exactly 0"), (None, "not gated")])
def test_band(ends, text):
    assert numbers.band(ends) == text


def test_an_order_is_never_printed_where_the_state_forbids_it():
    ladder = {"order": 1.98, "order_stderr": 0.03, "state": "asymptotic"}
    assert numbers.order(ladder) == "1.98 ± 0.03"
    assert numbers.order({**ladder, "order_stderr": 0.0021}) == "1.980 ± 0.002"
    for state in ("oscillatory", "round-off", "undetermined"):
        assert numbers.order({**ladder, "state": state}) == "–"
