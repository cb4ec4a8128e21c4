"""help() explains the package."""

import ast
import inspect
import json
import pydoc
import re
import sys
from pathlib import Path
from typing import get_type_hints

import pytest

import hidden_point_removal as hpr
from hidden_point_removal import Horizon, HprError, PointCloud, _native, tiles, types

TABLE = json.loads((Path(__file__).parents[2] / "src" / "options.json").read_text())
OPTIONS = list(TABLE["view"]["options"])
ASKS = [name for name in dir(PointCloud) if not name.startswith("_")]
TAKE_NO_OPTIONS = {"append", "auto_radius", "noise", "positions", "remove", "skipped", "spacing", "surface"}


def public():
    """(name, object) of everything that is public, and of its members."""
    for name in hpr.__all__:
        whole = getattr(hpr, name)
        yield name, whole
        if inspect.isclass(whole) and whole.__module__.startswith("hidden_point_removal") and not issubclass(whole, (HprError, dict)):
            for member in dir(whole):
                if not member.startswith("_"):
                    yield f"{name}.{member}", getattr(whole, member)


@pytest.mark.parametrize(("name", "whole"), list(public()), ids=lambda value: value if isinstance(value, str) else "")
def test_each_public_name_has_a_text_and_a_signature(name, whole):
    assert len(inspect.getdoc(whole) or "") > 10, name
    if callable(whole) and not inspect.isclass(whole):
        shown = inspect.signature(whole)
        assert not any(parameter.kind is parameter.VAR_KEYWORD for parameter in shown.parameters.values()), shown


@pytest.mark.parametrize("name", [name for name in ASKS if name not in TAKE_NO_OPTIONS])
def test_each_question_names_its_options(name):
    shown = inspect.signature(getattr(PointCloud, name)).parameters
    assert [option for option in OPTIONS if shown[option].kind is inspect.Parameter.KEYWORD_ONLY] == OPTIONS
    cloud = PointCloud([[0.0, 0, 1], [1, 0, 0]])
    given = {option: None for option in shown if option in OPTIONS}
    required = [p.name for p in shown.values() if p.default is p.empty and p.name != "self"]
    with pytest.raises(HprError) as refused:
        getattr(cloud, name)(*[None] * len(required), **given)
    assert "unknown option" not in str(refused.value)


def test_what_is_made_from_the_table_of_options_is_up_to_date():
    assert list(inspect.signature(PointCloud.visible_from).parameters)[2:] == [*OPTIONS, "threads"]
    assert sorted(get_type_hints(types.Options)) == sorted([*OPTIONS, "threads"])
    shown = " ".join(inspect.getdoc(PointCloud.visible_from).split())
    for name, row in TABLE["view"]["options"].items():
        # Up to the first link or dictionary, which Python writes in its own way.
        text = re.split(r"[\[{]", row["short"])[0].strip("`( ")
        assert f"{name}: " in shown and text[1:] in shown, name
    questions = {"mesh": PointCloud.reconstruct, "light": PointCloud.illuminate, "panorama": PointCloud.panorama, "map": PointCloud.visibility_map,
                 "many": PointCloud.coverage, "placement": PointCloud.place_viewpoints, "transfer": hpr.transfer}  # fmt: skip
    assert questions.keys() == TABLE.keys() - {"view"}
    for group, question in questions.items():
        named = {re.sub("[A-Z]", lambda letter: f"_{letter[0].lower()}", name) for name in TABLE[group]["options"]}
        assert named <= inspect.signature(question).parameters.keys(), group


def test_classes_show_how_to_make_them():
    assert list(inspect.signature(PointCloud).parameters) == ["positions", "non_finite"]
    assert list(inspect.signature(Horizon).parameters) == ["viewpoint", "radius", "inversion"]


def test_help_lists_signature_types_and_text():
    shown = pydoc.plain(pydoc.render_doc(PointCloud.visible_from))
    # Python 3.13 breaks a long signature into lines.
    assert "visible_from(self,/,viewpoint,*,radius=None," in "".join(shown.split())
    for words in ('radius: a number, "auto" or "opposite"', "Returns a `Visibility`", "Katz, Tal and Basri"):
        assert words in shown


def test_the_stub_names_what_there_is():
    stub = ast.parse((Path(_native.__file__).parent / "_native.pyi").read_text())
    own = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert own.keys() == {name for name in dir(_native) if not name.startswith("__")}
    for name, node in own.items():
        whole = getattr(_native, name)
        if isinstance(node, ast.ClassDef) and name != "HprError":
            members = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
            shown = {member for member in vars(whole) if not member.startswith("__")}
            assert {member for member in members if not member.startswith("__")} == shown
        else:
            members = {name: node} if isinstance(node, ast.FunctionDef) else {}
        for member, function in members.items():
            if any(isinstance(word, ast.Name) and word.id == "property" for word in function.decorator_list) or member.startswith("__"):
                continue
            given = [one.arg for one in (*function.args.args, *function.args.kwonlyargs)]
            there = list(inspect.signature(getattr(whole, member) if whole is not None and member != name else whole).parameters)
            assert [one for one in there if one not in (*OPTIONS, "threads", "options")] == [one for one in given if one not in OPTIONS], member


def test_the_version_is_that_of_the_package():
    package = Path(__file__).parents[1] / "pyproject.toml"
    assert f'version = "{hpr.__version__}"' in package.read_text()


def imported(statements):
    """What a module imports as soon as it is imported itself."""
    for node in statements:
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module
        elif isinstance(node, ast.If) and getattr(node.test, "id", "") != "TYPE_CHECKING":
            yield from imported([*node.body, *node.orelse])


def test_what_is_imported_is_installed_with_the_package():
    """On each Python: 3.10 has no typing.Unpack."""
    found = {name.split(".")[0] for file in Path(hpr.__file__).parent.glob("*.py") for name in imported(ast.parse(file.read_text()).body)}
    needed = re.search(r"^dependencies = (.*)$", (Path(__file__).parents[1] / "pyproject.toml").read_text(), re.MULTILINE)[1]
    assert found - sys.stdlib_module_names == set(re.findall(r'"(\w+)>=', needed)) == {"numpy", "typing_extensions"}


def test_everything_public_has_types():
    for module in (hpr, tiles, types):
        for name, whole in vars(module).items():
            if name.startswith("_") or not getattr(whole, "__module__", "").startswith("hidden_point_removal"):
                continue
            for function in [whole, *vars(whole).values()] if inspect.isclass(whole) else [whole]:
                if inspect.isfunction(function) and not function.__name__.startswith("_"):
                    code = function.__code__
                    given = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
                    assert {*given, "return"} - {"self"} <= function.__annotations__.keys(), function
