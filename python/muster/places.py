"""Where plugins lie."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

from ._muster import Error


def plugin_folders(first: Sequence[str | os.PathLike] = ()) -> list[str]:
    """The folders in which plugins are looked for, in order: `first`, those of the environment variable MUSTER_PLUGIN_PATH, and
    muster's own, in the build folder or below the prefix that holds this package. Raises Error for one that does not exist."""
    given = [os.fspath(folder) for folder in first]
    given += [folder for folder in os.environ.get("MUSTER_PLUGIN_PATH", "").split(":") if folder]
    for folder in given:
        if not os.path.isdir(folder):
            raise Error(f'plugins: "{folder}" is no folder')
    package = Path(__file__).resolve().parent
    # build/python/muster, or PREFIX/lib/python3/dist-packages/muster.
    own = (package.parents[1] / "plugins", package.parents[2] / "muster" / "plugins")
    return given + [str(folder) for folder in own if folder.is_dir()][:1]
