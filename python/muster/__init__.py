"""muster from Python: worlds loaded, stepped, read without a copy, steered, exchanged, and held against measurements.

    import muster
    simulation = muster.Simulation("worlds/square_path")
    simulation.run()
    print(simulation.digest(), simulation["robot/scarab/pose"])

Units are SI and radians, the world's frame is ENU, quaternions are w first. Everything that muster refuses is an `Error`.
"""

from ._muster import Error, Snapshot, Tick
from .calibration import diagnose, fit, plot
from .functions import Function, controller, radio_term
from .places import plugin_folders
from .simulation import Batch, Column, Event, Simulation

__all__ = [
    "Batch",
    "Column",
    "Error",
    "Event",
    "Function",
    "Simulation",
    "Snapshot",
    "Tick",
    "controller",
    "diagnose",
    "fit",
    "plot",
    "plugin_folders",
    "radio_term",
]
