// Sorting, filtering and keys. Without it every page is complete, reds first.
"use strict";

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.target.closest("input, select, textarea")) {
    if (event.key === "Escape") event.target.blur();
    return;
  }
  const selector = { p: "a[rel=prev]", n: "a[rel=next]", u: "a.up" }[event.key];
  const link = selector && document.querySelector(selector);
  if (link) link.click();
  const search = document.querySelector("input[type=search]");
  if (event.key === "/" && search) {
    event.preventDefault();
    search.focus();
  }
});

function sortable(table) {
  const body = table.tBodies[0];
  for (const [column, head] of [...table.tHead.rows[0].cells].entries()) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const now = head.getAttribute("aria-sort");
      const first = head.dataset.first || "ascending";
      const next = now === null ? first : now === "ascending" ? "descending" : "ascending";
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", next);
      const sign = next === "ascending" ? 1 : -1;
      const key = (row) => row.cells[column].dataset.value;
      const compare = head.dataset.sort === "number"
        ? (a, b) => Number(key(a)) - Number(key(b))
        : (a, b) => key(a).localeCompare(key(b), "en", { numeric: true });
      body.append(...[...body.rows].sort((a, b) => sign * compare(a, b)));
    });
  }
}

function filterable(form, table) {
  const rows = [...table.tBodies[0].rows].filter((row) => row.dataset.verdict);
  const shown = document.getElementById("shown");
  const apply = () => {
    const data = new FormData(form);
    const verdicts = data.getAll("verdict");
    const words = data.get("text").toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of rows) {
      const keep = (!verdicts.length || verdicts.includes(row.dataset.verdict)) &&
        (!data.get("family") || row.dataset.family === data.get("family")) &&
        (!data.get("class") || row.dataset.class.split(" ").includes(data.get("class"))) &&
        words.every((word) => row.dataset.text.includes(word));
      row.hidden = !keep;
      count += keep;
    }
    shown.textContent = count === rows.length ? `${count} shown` : `${count} of ${rows.length} shown`;
  };
  form.hidden = false;
  form.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => setTimeout(apply));
  for (const link of document.querySelectorAll("a[data-verdict], a[data-family]")) {
    link.addEventListener("click", () => {
      form.reset();
      for (const box of form.querySelectorAll("input[name=verdict]")) box.checked = box.value === link.dataset.verdict;
      form.elements.family.value = link.dataset.family || "";
      apply();
    });
  }
  apply();
}

for (const table of document.querySelectorAll("table.sortable")) sortable(table);
const form = document.querySelector("form.filters");
if (form) filterable(form, document.querySelector("table.cases"));
