"""Many defects in one program: what is written in the place of statements, and what is left to be compiled alone."""

from pathlib import Path

import pytest

from defects import patches, switches
from defects.units import folds, names_in

ROOT = Path(__file__).resolve().parents[2]


def written(old, new, more=()):
    return switches.alternatives(old.split("\n"), [(7, new.split("\n")), *((n, t.split("\n")) for n, t in more)])


@pytest.mark.parametrize("old, new, text", [
    ("a += b;", "a -= b;", "if (furrow::planted(7)) { a -= b; } else { a += b; }"),
    ("  a();  // twice", "", "if (furrow::planted(7)) {  } else { a(); }"),
    ("const double f = x;", "const double f = y;", "const double f = furrow::planted(7) ? double(y) : double(x);"),
    ("const double a = x, b = g(x, y);", "const double a = x, b = g(y, x);",
     "const double a = x, b = furrow::planted(7) ? double(g(y, x)) : double(g(x, y));"),
    ("Vector<Dim> v = -n;", "Vector<Dim> v = n;", "Vector<Dim> v = furrow::planted(7) ? Vector<Dim>(n) : Vector<Dim>(-n);"),
    ("if (a < b) {", "if (a > b) {", "if (furrow::planted(7) ? bool(a > b) : bool(a < b)) {"),
    ("double f(double x) const { return x; }", "double f(double x) const { return -x; }",
     "double f(double x) const { if (furrow::planted(7)) { return -x; } else { return x; } }"),
    ("for (int i = 0; i < n; ++i) a[i] = 0;", "for (int i = 1; i < n; ++i) a[i] = 0;",
     "if (furrow::planted(7)) { for (int i = 1; i < n; ++i) a[i] = 0; } else { for (int i = 0; i < n; ++i) a[i] = 0; }"),
])
def test_statements_become_alternatives(old, new, text):
    assert written(old, new) == text


def test_two_defects_of_one_statement_are_a_chain():
    assert written("a = 1;", "a = 2;", [(9, "a = 3;")]) == (
        "if (furrow::planted(7)) { a = 2; } else if (furrow::planted(9)) { a = 3; } else { a = 1; }")


@pytest.mark.parametrize("old, new", [
    ("static constexpr double support = 2.0;", "static constexpr double support = 3.0;"), ("Step step{a};", "Step step{b};"),
    ("for (int i = 0; i < n; ++i) {", "for (int i = 1; i < n; ++i) {"), ("const double a = x;", "const double b = x;"),
    ("template <int Dim>", "template <int N>"), ("void f(int a) {", "void f(double a) {"),
    ("a = 1; double b = a;", "a = 2; double b = a;")])
def test_what_is_no_statement_is_refused(old, new):
    with pytest.raises(switches.CannotSwitch):
        written(old, new)


def test_a_change_grows_to_whole_statements():
    source = ["void f() {", "  const double a =", "      b + c;", "  g();", "}"]
    change = switches.grown(1, "f.cpp", 2, 3, ["      b - c;"], source)
    assert (change.first, change.last, change.new) == (1, 3, ("  const double a =", "      b - c;"))


def test_a_plan_writes_files_and_leaves_what_overlaps():
    text = '#include "a.hpp"\nvoid f() {\n  a = 1;\n  b = 1;\n}\n'

    def patch(old, new, at):
        return f"diff --git a/f.cpp b/f.cpp\n--- a/f.cpp\n+++ b/f.cpp\n@@ -{at} +{at} @@\n{old}\n{new}\n"
    defects = {1: ("one", patch("-  a = 1;", "+  a = 2;", 3)), 2: ("two", patch("-  b = 1;", "+  b = 2;", 4)),
               3: ("both", patch("-  a = 1;\n-  b = 1;", "+  a = 5;", 3)), 4: ("gone", patch("-  c = 1;", "+  c = 2;", 3))}
    files, planted, refused = switches.plan(defects, {"f.cpp": text}.get)
    assert planted == {1, 2} and set(refused) == {"both", "gone"} and "overlaps" in refused["both"]
    assert files["f.cpp"].startswith(f'#include "{switches.HEADER}"\n#include "a.hpp"\n')
    assert "planted(1)" in files["f.cpp"] and "planted(2)" in files["f.cpp"]


def test_nearly_all_defects_can_be_switched():
    found = [d for d in patches.read_all() if not d.right]
    known = {n: (d.name, d.path.read_text().partition("\n\n")[2]) for n, d in enumerate(found, 1)}
    _, planted, _ = switches.plan(known, lambda f: (ROOT / f).read_text() if (ROOT / f).exists() else None)
    assert len(planted) > 0.9 * len(found)


def test_line_tables_name_files_and_folders(tmp_path):
    text = "  [     0]  /tree/build\n  [    1f]  ../../solver/materials\n  [    30]  linear_eos.hpp\n  [    41]  /usr/include\n"
    assert names_in(text) == {"solver/materials", "linear_eos.hpp"}
    header = tmp_path / "a.hpp"
    header.write_text("static constexpr double pi = 3.0;\n")
    assert folds(header)
    header.write_text('static constexpr std::string_view name = "a";\n')
    assert not folds(header)
