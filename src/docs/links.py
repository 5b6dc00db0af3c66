# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of pages of HTML: files and anchors that they lead to, and what they would fetch from elsewhere."""
import html.parser
import urllib.parse


class Page(html.parser.HTMLParser):
    """Anchors, links and what is fetched (scripts, styles, pictures) of one page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.fetched = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.anchors |= {given[key] for key in ("id", "name") if given.get(key)}
        if tag in ("a", "area") and given.get("href"):
            self.links.append(given["href"])
        if tag == "link" and given.get("href") and given.get("rel") not in ("canonical", "search"):
            self.fetched.append(given["href"])
        if tag in ("script", "img", "iframe", "source", "video") and given.get("src"):
            self.fetched.append(given["src"])


def broken(folder):
    """A line for every link that leads nowhere, and for everything that is fetched from a host. Doxygen's own pages
    (api) are looked at as targets only."""
    known = {}

    def page(file):
        if file not in known:
            known[file] = Page(file.read_text(encoding="utf-8", errors="replace"))
        return known[file]

    complaints = []
    for file in sorted(folder.rglob("*.html")):
        name = file.relative_to(folder)
        if name.parts[0] in ("api", "_static", "players"):
            continue
        for target in page(file).fetched + page(file).links:
            parts = urllib.parse.urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in page(file).fetched and parts.scheme != "data":
                    complaints.append(f"{name}: fetches {target}")
                continue
            path = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
            if not path.exists():
                complaints.append(f"{name}: {target} leads nowhere")
            elif parts.fragment and path.suffix == ".html" and parts.fragment not in page(path).anchors:
                if not (parts.fragment.startswith("a") and path.parent.name == "api"):
                    complaints.append(f"{name}: {target}: no such place in {path.name}")
    return complaints
