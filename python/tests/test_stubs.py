"""Every public name is in the stubs with the same arguments, and says what it does."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path

import dbd
import dbd._dbd as compiled

STUBS = ast.parse((Path(dbd.__file__).parent / "_dbd.pyi").read_text())
TYPE = {node.name: node for node in STUBS.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in STUBS.body if isinstance(node, ast.FunctionDef)}
OWN = {"__getitem__", "__setitem__", "__copy__", "__deepcopy__", "__reduce__"}


def arguments(node: ast.FunctionDef) -> list[tuple[str, str]]:
    names = [(one.arg, "positional") for one in [*node.args.posonlyargs, *node.args.args]]
    return [one for one in names if one[0] != "self"] + [(one.arg, "keyword") for one in node.args.kwonlyargs]


def of(function: object) -> list[tuple[str, str]]:
    parameters = inspect.signature(function).parameters.values()  # type: ignore[arg-type]
    kinds = [(one.name, "keyword" if one.kind is one.KEYWORD_ONLY else "positional") for one in parameters]
    return [one for one in kinds if one[0] != "self"]


def test_the_class_is_whole() -> None:
    members = {node.name: node for node in TYPE["Plant"].body if isinstance(node, ast.FunctionDef)}
    there = {name for name in vars(dbd.Plant) if not name.startswith("_")} | OWN
    assert there | {"__init__"} == set(members)
    for name in there - OWN:
        member = vars(dbd.Plant)[name]
        assert inspect.getdoc(getattr(dbd.Plant, name)), name
        is_property = any(isinstance(mark, ast.Name) and mark.id == "property" for mark in members[name].decorator_list)
        assert is_property == inspect.isgetsetdescriptor(member), name
        if not is_property:
            assert arguments(members[name]) == of(getattr(dbd.Plant, name)), name
        assert ast.get_docstring(members[name]), name
    assert arguments(members["__init__"]) == of(dbd.Plant)


def test_the_module_is_whole() -> None:
    values = {node.target.id for node in STUBS.body if isinstance(node, ast.AnnAssign)}  # type: ignore[union-attr]
    public = {name for name in vars(compiled) if not name.startswith("_")} | {"__version__"}
    assert public == values | set(TYPE) | set(FUNCTIONS)
    assert arguments(FUNCTIONS["rollouts"]) == of(dbd.rollouts)
    for name in dbd.__all__:
        thing = getattr(dbd, name)
        assert name in values or inspect.getdoc(thing), name
    assert (Path(dbd.__file__).parent / "py.typed").exists()
