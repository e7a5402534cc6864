"""Declare an instrument as a chain of bodies with small errors, once, and get everything that follows from it.

Angles are radians and lengths metres everywhere, unless a text says another unit: ``"2 arcsec"``.

>>> import numpy as np
>>> import trueaxis
>>> chain = trueaxis.Chain.from_text('''
... chain Turntable {
...     body table on ground { position_error: Rx(tilt); motion: Rz(alpha); }
...     observe pointing: direction(1, 0, 0) of table;
... }''')
>>> x, y, z = chain.exact({"alpha": np.array([0.0, np.pi / 2])}, {"tilt": "10 arcsec"})
"""

from ._answers import Answer
from ._calibration import Calibration, calibrate
from ._chain import Chain, ClosedForm, Observable, Symbol, check
from ._cluster import apply
from ._compiled import Compiled
from ._errors import Mistake, MistakeError, TrueaxisError, TrueaxisWarning
from ._fit import Fit, fit
from ._instrument import Instrument, compare
from ._native import __version__
from ._tables import Table

__all__ = [
    "Answer",
    "Calibration",
    "Chain",
    "ClosedForm",
    "Compiled",
    "Fit",
    "Instrument",
    "Mistake",
    "MistakeError",
    "Observable",
    "Symbol",
    "Table",
    "TrueaxisError",
    "TrueaxisWarning",
    "__version__",
    "apply",
    "calibrate",
    "check",
    "compare",
    "fit",
]
