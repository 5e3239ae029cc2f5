"""Many defects in one program: where a patch changes whole statements, both are kept, and the environment says which one runs
(FURROW_DEFECT, the number of the defect). One build then serves all defects that can be written so; to compile each of them alone
takes a hundred times as long. What cannot be written so is left to be compiled alone.

    a += m * g;          becomes     if (furrow::planted(7)) { a -= m * g; } else { a += m * g; }
    const double f = x;  becomes     const double f = furrow::planted(8) ? double(y) : double(x);
"""

import re
from dataclasses import dataclass

HEADER = "solver/tensor/planted.hpp"
HEADER_TEXT = """#pragma once

#include <cstdlib>
#include <type_traits>

namespace furrow {

/// The defect that is switched on in this process; 0 for none.
inline const int planted_defect = [] {
  const char* const text = std::getenv("FURROW_DEFECT");
  return text ? std::atoi(text) : 0;
}();

constexpr bool planted(int number) {
  if (std::is_constant_evaluated())
    return false;
  else
    return planted_defect == number;
}

}  // namespace furrow
"""


class CannotSwitch(Exception):
    """A change that is not one of whole statements."""


@dataclass(frozen=True)
class Change:
    """Lines [first, last) of a file, from 0, and what a defect has in their place."""
    number: int
    file: str
    first: int
    last: int
    new: tuple


def changes_of(number, difference, sources):
    """Changes of a patch, each grown to whole statements. `sources`: file -> lines."""
    found, file = [], None
    lines = difference.splitlines()
    i = 0
    while i < len(lines):
        line = lines[i]
        if line.startswith("+++ "):
            file = line[6:]
            if not file.endswith((".cpp", ".hpp")) or file not in sources:
                raise CannotSwitch(f"{file} is no source")
        elif line.startswith("@@"):
            i += 1
            body = []
            while i < len(lines) and lines[i][:1] in (" ", "+", "-"):
                body.append(lines[i])
                i += 1
            found += _of_hunk(number, file, int(re.match(r"@@ -(\d+)", line)[1]), body, sources[file])
            continue
        i += 1
    return found


def _of_hunk(number, file, at, body, source):
    old = [x[1:] for x in body if x[0] != "+"]
    start = _find(source, old, at - 1)
    found, here, k = [], start, 0
    while k < len(body):
        if body[k][0] == " ":
            here, k = here + 1, k + 1
            continue
        removed, added = [], []
        while k < len(body) and body[k][0] != " ":
            (removed if body[k][0] == "-" else added).append(body[k][1:])
            k += 1
        found.append(grown(number, file, here, here + len(removed), added, source))
        here += len(removed)
    return found


def _find(source, old, near):
    places = [k for k in range(len(source) - len(old) + 1) if source[k:k + len(old)] == old]
    if not places:
        raise CannotSwitch("its context is not there")
    return min(places, key=lambda k: abs(k - near))


def code(line):
    """A line without its comment and the insides of its strings."""
    return re.sub(r'"(?:[^"\\]|\\.)*"', '""', line).split("//")[0].rstrip()


def grown(number, file, first, last, new, source):
    """The change of lines [first, last), grown to where a statement begins and ends."""
    new = list(new)
    while first > 0 and code(source[first - 1]) and code(source[first - 1])[-1] not in ";{}:":
        first -= 1
        new.insert(0, source[first])
    while last < len(source) and last > first and (code(source[last - 1])[-1:] not in (";", "{", "}")
                                                   or code(source[last]).lstrip().startswith("else")):
        new.append(source[last])
        last += 1
    return Change(number, file, first, last, tuple(new))


def written(source, changes):
    """Text of a file with its changes; those of the same lines are alternatives. CannotSwitch where one cannot be written."""
    by_place = {}
    for change in changes:
        by_place.setdefault((change.first, change.last), []).append(change)
    lines = list(source)
    for (first, last), here in sorted(by_place.items(), reverse=True):
        lines[first:last] = [alternatives(source[first:last], [(c.number, list(c.new)) for c in here])]
    at = next(k for k, line in enumerate(lines) if line.startswith("#include"))
    lines.insert(at, f'#include "{HEADER}"')
    return "\n".join(lines) + "\n"


def alternatives(old, others):
    """One statement, or a few, in the place of `old` lines and each of `others`, (number, lines)."""
    before, choices = _text(old), [(n, _text(new)) for n, new in others]
    if all(_balanced(t) for t in (before, *(t for _, t in choices))):
        for way in (_function, _declaration, _statement):
            if (text := way(before, choices)) is not None:
                return text
    elif (text := _condition(before, choices)) is not None:
        return text
    raise CannotSwitch("it does not change whole statements")


def _text(lines):
    return " ".join(code(line).strip() for line in lines).strip()


def _balanced(text):
    return all(text.count(a) == text.count(b) for a, b in ("()", "{}", "[]"))


def _chain(choices, before, wrap):
    """C++ ternary: each choice when its defect is planted, else what was there before."""
    return "".join(f"furrow::planted({n}) ? {wrap(t)} : " for n, t in choices) + wrap(before)


def _condition(before, choices):
    """if (...) { or } else if (...) {: the condition alone differs."""
    parts = [re.fullmatch(r"((?:\} else )?if \()(.*)(\) \{)", t) for t in (before, *(t for _, t in choices))]
    if any(p is None or not _balanced(p[2]) or ";" in p[2] for p in parts) or len({p[1] for p in parts}) > 1:
        return None
    condition = _chain([(n, p[2]) for (n, _), p in zip(choices, parts[1:])], parts[0][2], lambda t: f"bool({t})")
    return f"{parts[0][1]}{condition}{parts[0][3]}"


def _function(before, choices):
    """A function on one line."""
    parts = [re.fullmatch(r"((?!if|for|while|switch|return)[^={};]*\)(?: const)? )\{ (.*) \}", t) for t in (before, *(t for _, t in choices))]
    if any(p is None for p in parts):
        return None
    if len({p[1] for p in parts}) > 1 or any(p[1].startswith(("if", "for")) for p in parts):
        return None
    return f"{parts[0][1]}{{ {_statement(parts[0][2], [(n, p[2]) for (n, _), p in zip(choices, parts[1:])])} }}"


DECLARATION = re.compile(r"((?:static )?(?:const(?:expr)? )?)((?:unsigned )?[A-Za-z_][\w:]*(?:<[\w:, ]*>)?)(&? )([A-Za-z_]\w* = .*);")


def _declaration(before, choices):
    parts = [DECLARATION.fullmatch(t) for t in (before, *(t for _, t in choices))]
    if parts[0] is None or parts[0][2] in ("return", "using", "else"):
        return None
    if any(p is None or p.group(1, 2, 3) != parts[0].group(1, 2, 3) for p in parts) or "constexpr" in parts[0][1]:
        raise CannotSwitch("a declaration that becomes another")
    declarators = [_split(p[4]) for p in parts]
    names = [[d.partition(" = ")[0] for d in ds] for ds in declarators]
    if any(n != names[0] for n in names) or any(" = " not in d for ds in declarators for d in ds):
        raise CannotSwitch("a declaration of other names")
    kind = parts[0][2]

    def wrap(text):
        return f"({text})" if kind == "auto" or parts[0][3] != " " else f"{kind}{text}" if text.startswith("{") else f"{kind}({text})"
    made = []
    for k, name in enumerate(names[0]):
        values = [ds[k].partition(" = ")[2] for ds in declarators]
        differ = [(n, v) for (n, _), v in zip(choices, values[1:]) if v != values[0]]
        made.append(f"{name} = {_chain(differ, values[0], wrap) if differ else values[0]}")
    return f"{parts[0][1]}{kind}{parts[0][3]}{', '.join(made)};"


def _split(text):
    """At commas outside of brackets."""
    parts, depth, start = [], 0, 0
    for k, c in enumerate(text):
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            parts.append(text[start:k].strip())
            start = k + 1
    return [*parts, text[start:].strip()]


def _statement(before, choices):
    for text in (before, *(t for _, t in choices)):
        if re.match(r"(static|constexpr|template|struct|class|public|private|case|else|\}|#|using)\b", text):
            raise CannotSwitch("no statement")
        if text and text[-1] not in ";}":
            raise CannotSwitch("no statement")
        if re.match(r"[A-Z]\w*(<[\w:, ]*>)? \w+[{(]", text):
            raise CannotSwitch("a declaration")
        if re.search(r"(^|[;{}] )(const )?(auto|double|int|bool|Vector<Dim>|Matrix<Dim>|Tensor|Lanes|LaneVector<Dim>)&? \[?\w+", text) \
                and not text.startswith(("if", "for", "{")):
            raise CannotSwitch("statements with a declaration")
    chain = "".join(f"if (furrow::planted({n})) {{ {t} }} else " for n, t in choices)
    return f"{chain}{{ {before} }}"


def plan(defects, read):
    """(file -> text, numbers of the defects in them, name -> why not): `defects`: number -> (name, difference); `read(file)`: text
    of a file of the clean tree, or None."""
    sources, chosen, refused = {}, [], {}
    for number, (name, difference) in defects.items():
        try:
            for line in difference.splitlines():
                if line.startswith("+++ ") and line[6:] not in sources and (text := read(line[6:])) is not None:
                    sources[line[6:]] = text.splitlines()
            changes = changes_of(number, difference, sources)
            if any(_clash(a, b) for a in changes for b in chosen):
                raise CannotSwitch("it overlaps with another one")
            for change in changes:
                alternatives(sources[change.file][change.first:change.last], [(number, list(change.new))])
            chosen += changes
        except CannotSwitch as error:
            refused[name] = str(error)
    files = {f: written(sources[f], [c for c in chosen if c.file == f]) for f in {c.file for c in chosen}}
    return files, {c.number for c in chosen}, refused


def _clash(a, b):
    if a.file != b.file or (a.first, a.last) == (b.first, b.last):
        return False
    return a.first < max(b.last, b.first + 1) and b.first < max(a.last, a.first + 1)
