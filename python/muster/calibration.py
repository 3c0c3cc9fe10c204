"""A world held against measured readings; and a plot of what was recorded."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence, Union

from . import _muster
from .places import plugin_folders

Path = Union[str, "os.PathLike[str]"]


def fit(
    world: Path,
    data: Path,
    *,
    free: Sequence[str] = (),
    fix: Mapping[str, float] | Sequence[str] = (),
    cell: float = 0.25,
    least: int = 5,
    average: str = "dB",
    out: Path = "",
    plugins: Sequence[Path] = (),
) -> dict[str, Any]:
    """Fits a world's free parameters to measured readings: what `muster fit --json` prints.

    data: a CSV table (docs/reference/table_format.md). free: paths of parameters to free beyond the declared ones. fix: paths
    to hold, or a dict with their values. cell: side of the averaged cells in m; least: readings of a cell; average: "dB" or
    "power". out: a folder for figures. Of the result, `parameters` lists name, value, stderr, lower95, upper95 and unit,
    `misfit` tells where the fitted world errs. Raises Error.
    """
    held = [f"{path}={value!r}" for path, value in fix.items()] if isinstance(fix, Mapping) else list(fix)
    if average not in ("dB", "power"):
        raise _muster.Error(f'average: "{average}" is no average; expected one of dB, power')
    words = (os.fspath(world), os.fspath(data), os.fspath(out), list(free), held, cell, least, average == "power")
    return json.loads(_muster.fit(*words, plugin_folders(plugins)))


def diagnose(world: Path, data: Path, *, out: Path = "", plugins: Sequence[Path] = ()) -> dict[str, Any]:
    """Finds what a world gets wrong about measured readings and names the cause: what `muster diagnose --json` prints
    (docs/reference/diagnosis_format.md).

    out: a folder for the report and the extended world, which is then diagnosed again. Takes seconds to minutes; Ctrl-C ends
    it. Raises Error.
    """
    return json.loads(_muster.diagnose(os.fspath(world), os.fspath(data), os.fspath(out), plugin_folders(plugins)))


def plot(
    file: Path,
    x: Sequence[float],
    y: Sequence[float] | Mapping[str, Sequence[float]],
    *,
    x_label: str = "",
    y_label: str = "",
    title: str = "",
) -> None:
    """Draws y over x as SVG; of a dict, a line for each name. NaN interrupts a line. Raises Error for lengths that differ."""
    lines = y if isinstance(y, Mapping) else {"": y}
    named = [(name, [float(v) for v in values]) for name, values in lines.items()]
    _muster.plot(os.fspath(file), [float(v) for v in x], named, x_label, y_label, title)
