"""Numbers, units and symbols as a reader wants them: four digits that mean something, SI signs, real minus signs."""

import math
import re

from markupsafe import Markup, escape

MINUS = "\u2212"
SUPERSCRIPTS = str.maketrans("0123456789-+()abcdehijklmnoprstuvxyz", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺⁽⁾ᵃᵇᶜᵈᵉʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛˣʸᶻ")
SUBSCRIPTS = str.maketrans("0123456789-+()aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉₋₊₍₎ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
GREEK = {name: chr(code) for name, code in {
    "alpha": 0x3B1, "beta": 0x3B2, "gamma": 0x3B3, "delta": 0x3B4, "epsilon": 0x3B5, "zeta": 0x3B6, "eta": 0x3B7, "theta": 0x3B8,
    "kappa": 0x3BA, "lambda": 0x3BB, "mu": 0x3BC, "nu": 0x3BD, "xi": 0x3BE, "pi": 0x3C0, "rho": 0x3C1, "sigma": 0x3C3,
    "tau": 0x3C4,
    "phi": 0x3C6, "chi": 0x3C7, "psi": 0x3C8, "omega": 0x3C9, "Gamma": 0x393, "Delta": 0x394, "Sigma": 0x3A3, "Omega": 0x3A9,
    "nabla": 0x2207, "grad": 0x2207, "sum": 0x2211, "int": 0x222B, "infinity": 0x221E, "inf": 0x221E}.items()}

PROSE = {"sum", "int", "inf", "grad"}   # operators in a formula, words in a label


def number(x, digits=4):
    """Four significant digits without padding zeros; 1.3e−12 for the very small and the very large."""
    if x is None:
        return "–"
    if isinstance(x, bool):
        return "yes" if x else "no"
    if isinstance(x, int) and abs(x) < 10**15:
        return f"{x:,}".replace(",", "\u202f").replace("-", MINUS) if abs(x) >= 10000 else str(x).replace("-", MINUS)
    x = float(x)
    if not math.isfinite(x):
        return str(x).replace("-", MINUS)
    if x == 0.0:
        return "0"
    if 1e-4 <= abs(x) < 1e5:
        magnitude = math.floor(math.log10(abs(x)))
        decimals = max(0, digits - 1 - magnitude)
        text = f"{x:.{decimals}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
    else:
        mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
        mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
        text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", MINUS)


def percent(fraction):
    """A share in percent with two or three digits, a large one as a multiple: 0.34 -> 34 %, 240 -> 240 ×."""
    if fraction is None:
        return "–"
    if not math.isfinite(fraction):
        return "no bound"
    p = 100.0 * fraction
    if p == 0.0:
        return "0\u202f%"
    if p < 0.1:
        return "< 0.1\u202f%"
    if p >= 1000.0:
        return f"{number(fraction, 2)}\u202f×"
    digits = 1 if p < 10.0 else 0
    return f"{p:.{digits}f}\u202f%"


def with_uncertainty(value, uncertainty):
    """16.21 ± 0.10: the uncertainty to two digits, the value to the same decimal; without one, the value alone."""
    if value is None:
        return "–"
    if not uncertainty or not math.isfinite(uncertainty) or not 1e-4 <= abs(value) < 1e5:
        return number(value) + (f" ± {number(uncertainty, 2)}" if uncertainty else "")
    decimals = max(0, 1 - math.floor(math.log10(uncertainty)))
    if decimals > 8:
        return f"{number(value)} ± {number(uncertainty, 2)}"
    return f"{value:.{decimals}f} ± {uncertainty:.{decimals}f}".replace("-", MINUS)


def unit(text):
    """kg/m^3 -> kg/m³, um -> µm, deg -> °; nothing for a pure number."""
    text = (text or "").strip()
    if text in ("", "1", "-"):
        return ""
    text = re.sub(r"\^\(?([+-]?\d+)\)?", lambda m: m.group(1).translate(SUPERSCRIPTS), text)
    text = re.sub(r"\bum\b", "µm", text)
    text = re.sub(r"\bus\b", "µs", text)
    text = re.sub(r"\bdeg\b", "°", text)
    text = re.sub(r"\bohm\b", "Ω", text, flags=re.IGNORECASE)
    return text.replace("*", "·").replace("-", MINUS)


def quantity(value, unit_text):
    shown = unit(unit_text)
    return f"{number(value)}\u202f{shown}" if shown else number(value)


def with_unit(text, unit_text):
    """An axis or column label: 'length, mm'."""
    shown = unit(unit_text)
    return f"{label(text)}, {shown}" if shown else label(text)


def _greek(text, kept):
    return re.sub(r"(?<![A-Za-z])(" + "|".join(sorted(GREEK.keys() - kept, key=len, reverse=True)) + r")(?![A-Za-z])",
                  lambda m: GREEK[m.group(1)], text)


def _signs(text, kept=frozenset()):
    """Greek letters, operators, primes and a real minus, where a formula names them in ASCII."""
    text = _greek(text.replace("\\", ""), kept)
    if "∫" not in text:   # dx is the particle spacing, but neither under an integral nor in a derivative
        text = re.sub(r"(?<!d[A-Za-z]/)(?<!d/)(?<![A-Za-z])dx(?![A-Za-z])", "Δx", text)
    text = re.sub(r"(?<=[ (|,])-(?=[ \w(|∇∑])|^-(?=\w)", MINUS, text)
    text = re.sub(r"(?<=\b[^\W\d_])'+(?![A-Za-z0-9])", lambda m: "′" * len(m.group()), text)
    return re.sub(r"<((?:[∇∑] ?)?[A-Za-z](?:[_^]\w+)?)>", "⟨\\1⟩", text.replace("<=", "≤").replace(">=", "≥")).replace(" * ",
                                                                                                                       " · ")


def symbol(text):
    """A formula sign as HTML: L_f -> L with subscript f, h/dx -> h/Δx, rho_0 -> ρ with subscript 0; letters in italics."""
    text = _signs(text)
    parts, position = [], 0
    for match in re.finditer(r"([_^])(\{[^}]*\}|[^\W_]+|[*+\-∞])", text):
        parts.append(_upright(text[position:match.start()]))
        tag = "sub" if match.group(1) == "_" else "sup"
        parts.append(Markup(f"<{tag}>{{}}</{tag}>").format(match.group(2).strip("{}")))
        position = match.end()
    parts.append(_upright(text[position:]))
    return Markup("<i>{}</i>").format(Markup("").join(parts))


def _upright(text):
    """Names of functions and words (max, sinc, at) stand upright among italic letters."""
    pieces = re.split(r"(\b(?:[a-z]{3,}|at|by|in|of|on|to)\b)", text)
    return Markup("").join(Markup("<b>{}</b>").format(piece) if i % 2 else escape(piece) for i, piece in enumerate(pieces))


def _formulas(text, raised):
    """Plain text with the signs of its formulas, and `raised` called with (base sign, exponent or index) for ^ and _."""
    text = re.sub(r"\b(sum|int|grad)(?= [A-Za-z]\b)", lambda m: GREEK[m.group()], text)   # before a letter: no word of prose
    text = re.sub(r"\bL_?(inf|1|2)\b", lambda m: {"inf": "L∞", "1": "L₁", "2": "L₂"}[m.group(1)], _signs(text, PROSE))
    return re.sub(r"(?<=\S)(\^)(\{[^}]*\}|\([^()]*\)|[+-]?[^\W_]+)|(?<=\b[^\W_])(_)(\{[^}]*\}|[^\W_]{1,3}\b)",
                  lambda m: raised(m.group(1) or m.group(3), (m.group(2) or m.group(4)).strip("{}")), text)


def label(text):
    """Plain text that may hold formulas, for figures: h^2 -> h², h/dx -> h/Δx, c_0 -> c₀, sum V W -> ∑ V W."""
    def raised(sign, inner):
        table = SUPERSCRIPTS if sign == "^" else SUBSCRIPTS
        return inner.translate(table) if all(ord(c) in table for c in inner) else sign + inner
    return _formulas(text, raised)


def prose(text):
    """The same as HTML, where every letter can be raised or lowered: sigma_xy -> σ with subscript xy."""
    marked = str(escape(_formulas(text, lambda sign, inner: f"\ue000{sign}{inner}\ue001")))   # private signs until it is escaped
    return Markup(re.sub("\ue000([_^])(.*?)\ue001", lambda m: "<{0}>{1}</{0}>".format("sup" if m[1] == "^" else "sub", m[2]),
                         marked))


def words(name):
    """A name as words: gradient_l2 -> gradient L₂."""
    return re.sub(r"\bl(inf|1|2)\b", lambda m: {"inf": "L∞", "1": "L₁", "2": "L₂"}[m.group(1)], name.replace("_", " "))


def duration(seconds):
    """0.42 s, 12 s, 3 min 12 s, 1 h 04 min."""
    if seconds is None:
        return "–"
    if seconds < 0.001:
        return "< 1 ms"
    if seconds < 1.0:
        return f"{1000.0 * seconds:.0f} ms"
    if seconds < 10.0:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def size(bytes_):
    """Bytes in binary multiples: 512 MiB."""
    value = float(bytes_)
    for name in ("B", "KiB", "MiB", "GiB"):
        if value < 1024.0 or name == "GiB":
            return f"{value:.0f} {name}" if value >= 10.0 or name == "B" else f"{value:.1f} {name}"
        value /= 1024.0


_PREFIXES = {"m": ((1.0, "m"), (1e3, "mm"), (1e6, "µm")), "s": ((1.0, "s"), (1e3, "ms"), (1e6, "µs")),
             "Pa": ((1e-9, "GPa"), (1e-6, "MPa"), (1e-3, "kPa"), (1.0, "Pa"))}


def prefixed(largest, unit_text):
    """(factor, unit) that brings a largest magnitude in m, s or Pa into readable numbers; (1, unit) for anything else."""
    for factor, name in _PREFIXES.get(unit_text, ()):
        if largest * factor >= 0.5:
            return factor, name
    return (_PREFIXES[unit_text][-1] if unit_text in _PREFIXES and largest > 0.0 else (1.0, unit_text))


STATES = {
    "asymptotic": "asymptotic: the error falls at a steady rate as the spacing is refined",
    "plateau": "plateau: finer spacing no longer lowers the error at this h/Δx; the order is that of the falling part",
    "oscillatory": "oscillatory: the error goes up and down, so that no order can be claimed",
    "diverging": "diverging: the error grows as the spacing is refined",
    "round-off": "round-off: the error is as small as the arithmetic allows, so that no order can be claimed",
    "undetermined": "undetermined: too few spacings, or errors that do not lie on one power of the spacing",
}


def order(ladder):
    """Observed order with its standard error; where the state allows no order, a dash: a bare order is never printed."""
    if ladder["order"] is None or ladder["state"] in ("oscillatory", "round-off", "undetermined"):
        return "–"
    stderr = ladder["order_stderr"]
    decimals = 3 if stderr is not None and stderr < 0.005 else 2
    text = f"{ladder['order']:.{decimals}f}" + (f" ± {stderr:.{decimals}f}" if stderr is not None else "")
    return text.replace("-", MINUS)


def band(ends, unit_text="", factor=1.0):
    """A band in words that fit a table: [−3, 3] %, ≤ 1e−10, ≥ 1.7."""
    if ends is None:
        return "not gated"
    low, high = ends
    shown = unit(unit_text)
    tail = f"\u202f{shown}" if shown else ""
    if low is None and high is None:
        return "any finite number"
    if low is None:
        return f"≤ {number(factor * high)}{tail}"
    if high is None:
        return f"≥ {number(factor * low)}{tail}"
    if low == high:
        return f"exactly {number(factor * low)}{tail}"
    if low == -high:
        return f"± {number(factor * high)}{tail}"
    return f"{number(factor * low)} … {number(factor * high)}{tail}"
