# For Sphinx; docs/build runs it on the pages that docs/site.py gathers.
import re
from pathlib import Path

project = "RRCB"
extensions = ["myst_parser"]
root_doc = "README"
html_theme = "furo"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_static_path = ["site.css", "site.js"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
# The version is a folder of the site, so that links to pages of this version stay valid. The address and that of the
# source are empty until a release fills them.
citation = (Path(__file__).resolve().parent / "CITATION.cff").read_text()
fields = dict(re.findall(r"^(version|url|repository-code): *(\S+)", citation, re.M))
release = version = fields["version"]
html_title = f"RRCB {version}"
html_baseurl = f"{fields['url']}/{version}/" if "url" in fields else ""
if "repository-code" in fields:
    html_theme_options = {"source_repository": fields["repository-code"], "source_branch": f"v{version}",
                          "source_directory": ""}
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]
