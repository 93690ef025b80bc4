#!/usr/bin/env python3
"""Packs the add-on with the Python client inside:  build.py FILE.zip"""
import sys
import zipfile
from pathlib import Path

here = Path(__file__).resolve().parent
sources = {"seedmesh": here / "seedmesh", "seedmesh/client": here.parent / "python/src/seedmesh"}


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as archive:
        for name, folder in sources.items():
            for path in sorted(folder.glob("*")):
                if path.is_file():
                    archive.write(path, f"{name}/{path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
