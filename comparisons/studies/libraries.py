"""Fails where a library that draws or tabulates is missing; every program imports it first."""

import sys
from importlib.util import find_spec

for library in ("matplotlib", "pandas"):
    if find_spec(library) is None:
        package = f"python3-{library}"
        sys.exit(f"{library} is missing: tools/set_up installs the Debian package {package}")
