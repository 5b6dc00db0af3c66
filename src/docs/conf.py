# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx: pages in Markdown, classes from Doxygen's XML, formulas by MathJax beside the pages."""
import os

project = "SPAM"
author = "the authors of SPAM"
copyright = author  # noqa: A001
release = version = os.environ.get("SPAM_VERSION", "")

extensions = ["myst_parser", "breathe", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["files/**"]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4

breathe_projects = {"spam": os.environ.get("SPAM_DOXYGEN_XML", "")}
breathe_default_project = "spam"
breathe_default_members = ("members",)
breathe_show_include = True
primary_domain = "cpp"
highlight_language = "cpp"

# Version 2, the one of Debian; a copy of it, so that pages ask for nothing from elsewhere.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
mathjax2_config = {
    "messageStyle": "none",
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "processClass": "math|mathjax_process|output_area",
                "ignoreClass": "body"},
}

html_theme = "furo"
html_title = f"SPAM {version}".strip()
html_static_path = ["_static"]
html_extra_path = ["_extra"]
html_show_sphinx = False
html_copy_source = False
html_show_search_summary = False  # it would have to fetch pages, which browsers refuse to those opened as files
