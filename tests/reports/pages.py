"""Reads a report's pages as a browser would: elements, text, links; raises on a page that is not well-formed."""

from html.parser import HTMLParser

VOID = {"meta", "link", "img", "input", "br", "hr"}
LINKS = {"href", "src", "srcset", "action", "poster", "data", "xlink:href", "formaction"}


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.elements, self.ids, self.links, self.words, self.open = [], [], [], [], []
        self.feed(text)
        self.close()
        assert not self.open, f"never closed: {self.open}"

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        assert len(found) == len(attributes), f"<{tag}> has an attribute twice: {attributes}"
        self.elements.append((tag, found))
        if "id" in found:
            self.ids.append(found["id"])
        self.links += [(tag, key, value) for key, value in attributes if key in LINKS]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes <{(self.open or ['nothing'])[-1]}> at {self.getpos()}"
        self.open.pop()

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())

    def all(self, tag, class_=None, **attributes):
        return [a for t, a in self.elements if t == tag and (class_ is None or class_ in (a.get("class") or "").split())
                and all(a.get(k) == v for k, v in attributes.items())]
