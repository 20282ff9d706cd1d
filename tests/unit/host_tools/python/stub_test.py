"""The stub _core.pyi says of the extension module what is true, and every public name has a text."""

import ast
import importlib.util
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import tactus
from tactus import _core


def stub_names():
    """Returns the names of the stub: of a class the members, of a function the arguments, of a value None."""
    tree = ast.parse((pathlib.Path(tactus.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    found = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = [argument.arg for argument in node.args.args]
        elif isinstance(node, ast.ClassDef):
            found[node.name] = {
                getattr(member, "name", None) or member.target.id: member
                for member in node.body
                if isinstance(member, (ast.FunctionDef, ast.AnnAssign))
            }
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = None
    return found


def arguments_of(function):
    """Returns the names of the arguments in the signature that pybind11 writes."""
    signature = re.match(r"\w+\((.*)\) -> ", function.__doc__).group(1)
    return re.findall(r"(?:^|, )(\w+): ", signature)


def public(names):
    return {name for name in names if not name.startswith("_") or name in ("__version__", "__init__")}


class StubTest(unittest.TestCase):
    def test_it_has_the_names_of_the_module(self):
        self.assertEqual(public(stub_names()), public(vars(_core)))

    def test_functions_have_the_arguments_of_the_module(self):
        for name, arguments in stub_names().items():
            if isinstance(arguments, list):
                self.assertEqual(arguments, arguments_of(getattr(_core, name)), name)

    def test_classes_have_the_members_of_the_module(self):
        for name, members in stub_names().items():
            kind = getattr(_core, name, None)
            if not isinstance(members, dict) or issubclass(kind, Exception):
                continue
            has_constructor = "__init__" in vars(kind) and "No constructor" not in (kind.__init__.__doc__ or "")
            wanted = {each for each in public(vars(kind)) if each != "__init__" or has_constructor}
            if "__init__" not in members:
                wanted.discard("__init__")
            self.assertEqual(set(members), wanted, name)
            for member, node in members.items():
                self.compare_member(vars(kind)[member], node, f"{name}.{member}")

    def compare_member(self, found, node, name):
        is_value = isinstance(node, ast.AnnAssign) or any(
            isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list
        )
        self.assertEqual(is_value, isinstance(found, property), name)
        if not is_value:
            function = found.__func__ if isinstance(found, staticmethod) else found
            self.assertEqual([each.arg for each in node.args.args], arguments_of(function), name)

    def test_every_public_name_has_a_text_and_types(self):
        self.assertEqual(sorted(tactus.__all__), tactus.__all__)
        for name in tactus.__all__:
            value = getattr(tactus, name)
            if name == "__version__":
                continue
            self.assertTrue(inspect.getdoc(value), name)
            methods = [value] if inspect.isfunction(value) else [
                each for each in vars(value).values() if inspect.isfunction(each) and not each.__name__.startswith("_")
            ]
            for method in methods:
                self.assertTrue(inspect.getdoc(method), method)
                untyped = [
                    each
                    for each in inspect.signature(method).parameters.values()
                    if each.annotation is inspect.Parameter.empty and each.name != "self"
                ]
                self.assertEqual(untyped, [], method)
                self.assertIsNot(inspect.signature(method).return_annotation, inspect.Signature.empty, method)

    @unittest.skipIf(importlib.util.find_spec("mypy") is None, "mypy is not installed")
    def test_the_types_of_package_and_stub_go_together(self):
        with tempfile.TemporaryDirectory() as cache:
            result = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "-p", "tactus"],
                cwd=pathlib.Path(tactus.__file__).parents[1], capture_output=True, text=True, timeout=300,
            )
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((pathlib.Path(tactus.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
