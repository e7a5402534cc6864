"""What `trueaxis` is made of; use `trueaxis` itself."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

_Text = tuple[str, str]
_Column = NDArray[np.float64] | list[str]
_Columns = list[tuple[str, NDArray[np.float64]]]

class ClosedForm:
    title: str
    names: list[str]
    printed: list[str]
    text: list[str]
    latex: list[str]
    steps: list[list[tuple[str, str, int]]]

class Chain:
    @staticmethod
    def from_text(text: str, name: str) -> Chain: ...
    @staticmethod
    def from_file(path: str) -> Chain: ...
    @property
    def name(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def origin(self) -> str: ...
    @property
    def symbols(self) -> list[tuple[str, Any, str]]: ...
    @property
    def observables(self) -> list[tuple[str, Any, list[str], list[tuple[str, str]]]]: ...
    def evaluate(
        self,
        form: str,
        observable: str | None,
        readings: list[tuple[str, NDArray[np.float64]]],
        constants: list[tuple[str, float]],
        errors: _Text,
        wrt: list[str],
        out: NDArray[np.float64] | None,
        threads: int | None,
    ) -> NDArray[np.float64]: ...
    def closed_form(self, observable: str | None, order: int) -> ClosedForm: ...
    def identify(self, observables: list[str], candidate: str | None) -> tuple[str, str]: ...
    def bound(
        self, sizes: _Text, observables: list[str], ranges: list[tuple[str, str]], seed: int
    ) -> tuple[str, str]: ...
    def budget(
        self, sizes: _Text, observables: list[str], path: str | None, ranges: list[tuple[str, str]]
    ) -> tuple[str, str]: ...
    def simulate(
        self,
        values: _Text,
        poses: int,
        noise: list[str],
        seed: int,
        ranges: list[tuple[str, str]],
        observables: list[str],
    ) -> _Columns: ...
    def over_table(
        self,
        table: tuple[str, list[tuple[str, _Column]]],
        values: _Text,
        observables: list[str],
        is_exact: bool,
        is_value: bool,
    ) -> _Columns: ...

class Study:
    def __new__(cls, path: str, text: str | None, chain: Chain | None) -> Study: ...
    @property
    def tables(self) -> list[str]: ...

class Calibration:
    def text(self, is_verbose: bool) -> str: ...
    def report(self) -> str: ...
    def html(self, is_whole: bool) -> str: ...
    @property
    def amended(self) -> str | None: ...
    @property
    def errors_toml(self) -> str | None: ...
    @property
    def values(self) -> list[tuple[str, float]] | None: ...
    @property
    def found_over(self) -> list[tuple[str, float, float]] | None: ...
    def residuals(self) -> _Columns: ...
    def write(self, folder: str, all_residuals: bool) -> None: ...

_Rows = tuple[str, list[tuple[str, _Column]] | None]

class Fitting:
    def __new__(cls, study: tuple[str, str | None], chain: _Text | None, sample: _Rows) -> Fitting: ...
    @staticmethod
    def of_files(study: tuple[str, str | None], chain: _Text | None, files: list[str], rows: int) -> Fitting: ...
    @property
    def texts(self) -> tuple[_Text, _Text]: ...
    def copy(self) -> Fitting: ...
    def step(self) -> bytes | None: ...
    def take(self, files: list[list[bytes]]) -> None: ...
    def complete(
        self,
        calibration: Calibration,
        drawn: Fitting,
        files: int,
        sums: tuple[int, int, list[float], list[float]] | None,
    ) -> None: ...
    def found(self) -> str | None: ...

def stretches(rows: list[int], wanted: int, seed: int) -> list[list[tuple[int, int]]]: ...
def validate(
    study: _Text,
    before: tuple[_Text, _Text],
    after: tuple[_Text, _Text],
    rows: tuple[str, list[tuple[str, _Column]]],
    floor: list[float],
) -> tuple[int, int, list[float], list[float]]: ...
def accumulate(study: _Text, chain: _Text, rows: _Rows, pass_: bytes, /) -> bytes | None: ...
def calibrate(
    study: Study,
    tables: list[tuple[str, list[tuple[str, _Column]]]],
    command: str,
    progress: Callable[[str], object] | None,
) -> Calibration: ...

_Counted = tuple[int, int, list[tuple[int, float]]]

def apply(
    chain: Chain, table: tuple[str, list[tuple[str, _Column]]], errors: _Text, observables: list[str]
) -> tuple[_Columns, _Counted]: ...
def warn_of_outside(chain: Chain, errors: _Text, counted: list[_Counted]) -> None: ...
def read_text(path: str) -> str: ...
def check(claims: str) -> tuple[str, str]: ...
