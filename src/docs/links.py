# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of pages of HTML: files and anchors that they lead to, and what they would fetch from elsewhere."""
import html.parser
import re
import urllib.parse


class Page(html.parser.HTMLParser):
    """Anchors, links and what is fetched (scripts, styles, pictures) of one page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.fetched, self.programs = set(), [], [], []
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
        if tag == "script" and given.get("src") and given.get("type") != "module":
            self.programs.append(given["src"])


def wrong_in_static(file):
    """What a style sheet names and is not beside it, and a program that is a module and could not be read as a file."""
    text = file.read_text(encoding="utf-8", errors="replace")
    if file.suffix == ".css":
        for target in re.findall(r"""url\(\s*["']?([^"')\s]+)|@import\s+["']([^"']+)""", text):
            target = target[0] or target[1]
            if target.startswith(("data:", "#")):
                continue
            if target.startswith("/"):
                yield f"{target} is a path of a server"
            elif not (file.parent / re.split("[?#]", target)[0]).is_file():
                yield f"{target} leads nowhere"
    elif re.search(r"(?m)^(import|export) ", text):
        yield "is a module, which no browser runs in a page that is opened as a file"


def broken(folder):
    """A line for every link that leads nowhere, and for everything that is fetched from a host. Doxygen's own pages
    (api) are looked at as targets only."""
    known = {}

    def page(file):
        if file not in known:
            known[file] = Page(file.read_text(encoding="utf-8", errors="replace"))
        return known[file]

    complaints, seen = [], set()
    for file in sorted(folder.rglob("*.html")):
        name = file.relative_to(folder)
        if name.parts[0] in ("api", "_static", "players"):
            continue
        for target in page(file).fetched + page(file).links:
            parts = urllib.parse.urlsplit(target)
            static = (file.parent / parts.path).resolve()
            if (target in page(file).programs or static.suffix == ".css") and static.is_file() and static not in seen:
                seen.add(static)
                complaints += [f"{static.name}: {complaint}" for complaint in wrong_in_static(static)]
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
