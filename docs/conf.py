# SPDX-License-Identifier: Apache-2.0
# Sphinx's configuration; `scripts/docs` runs it with -W, so that every warning is an error.
project = "Noli"
author = "The Noli authors"
copyright = "The Noli authors, Apache-2.0"

extensions = ["myst_parser", "breathe"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
# Pages of other folders begin with headings of their own; a page of ours may include one below its title.
suppress_warnings = ["myst.header"]

root_doc = "index"
highlight_language = "none"
pygments_style = "friendly"

breathe_projects = {"noli": "../build/docs/doxygen/xml"}
breathe_default_project = "noli"
breathe_show_include = False
# `requires` and concepts are C++20, which Sphinx 5.3 parses only in part.
cpp_index_common_prefix = ["noli::"]

html_theme = "furo"
html_title = "Noli"
html_copy_source = False
html_show_sphinx = False
html_static_path = ["static"]
html_css_files = ["noli.css"]
