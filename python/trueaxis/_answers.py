"""Answers: a dictionary for programs that reads as the command prints it."""

from __future__ import annotations

import html
import json
from typing import Any


class Answer(dict[str, Any]):
    """What a command answers: the keys of its ``--format json``; ``print(answer)`` shows what the command prints."""

    text: str
    """What the command prints."""

    def __init__(self, text: str, answer: dict[str, Any]):
        super().__init__(answer)
        self.text = text

    @classmethod
    def _of(cls, told: tuple[str, str]) -> Answer:
        text, answer = told
        return cls(text, json.loads(answer))

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self):
        return type(self), (self.text, dict(self))
