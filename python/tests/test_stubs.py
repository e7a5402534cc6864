"""The stubs name what there is, and nothing else."""

import ast
from pathlib import Path

import trueaxis
from trueaxis import _native


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_every_name_of_the_native_part_has_a_stub():
    folder = Path(trueaxis.__file__).parent
    assert (folder / "py.typed").exists()
    stubs = ast.parse((folder / "_native.pyi").read_text())
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stubs.body if isinstance(node, ast.FunctionDef)}
    assert public(classes) | public(functions) == public(vars(_native))
    for name, node in classes.items():
        members = {
            member.name if isinstance(member, ast.FunctionDef) else member.target.id
            for member in node.body
            if isinstance(member, (ast.FunctionDef, ast.AnnAssign))
        }
        assert public(members) == public(vars(getattr(_native, name))), name


def test_everything_public_says_what_it_is():
    for name in trueaxis.__all__:
        thing = getattr(trueaxis, name)
        if name == "__version__":
            continue
        assert thing.__doc__, name
        if isinstance(thing, type):
            for member in public(vars(thing)):
                if callable(getattr(thing, member)) or isinstance(vars(thing)[member], property):
                    assert getattr(thing, member).__doc__, f"{name}.{member}"
