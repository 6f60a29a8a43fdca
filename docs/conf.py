# For Sphinx; docs/build runs it on the pages that docs/site.py gathers.
project = "RRCB"
extensions = ["myst_parser"]
root_doc = "README"
html_theme = "furo"
html_title = "RRCB"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_static_path = ["site.css", "site.js"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
# A placeholder until the project has an address. Packages repeat it, which install.recipes compares.
html_baseurl = "https://rrcb.invalid/"
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]
