# SPDX-License-Identifier: GPL-3.0-or-later
"""The package and a user's script are typed, as mypy reads them; what is told to it is what is there."""
import ast
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import argil
from argil import _native

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parents[1] / "python"


def mypy(tmp_path, *words, text=None):
    pytest.importorskip("mypy", reason="mypy is not there; remedy: apt install python3-mypy")
    if text is not None:
        (tmp_path / "wrong.py").write_text(text)
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), *map(str, words)],
        cwd=tmp_path, env={**os.environ, "MYPYPATH": str(SOURCES)}, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, timeout=280)


def test_mypy_is_content_with_the_package_and_a_user(tmp_path):
    done = mypy(tmp_path, SOURCES / "argil" / "__init__.py", HERE / "typed_user.py")
    assert done.returncode == 0, done.stdout


def test_mypy_sees_what_is_wrong(tmp_path):
    done = mypy(tmp_path, "wrong.py", text="import argil\nargil.Clay.ball('3')\nargil.Clay.ball(3).melt()\n"
                                           "x: int = argil.Clay.ball(3).hash()\n")
    assert done.returncode == 1 and done.stdout.count("error:") == 3, done.stdout


def test_the_typed_script_runs():
    import typed_user
    numbers = typed_user.main()
    assert np.isfinite(numbers).all() and numbers[-1] == 3


def test_the_stub_names_what_the_extension_has():
    """Names and parameters of every class and function, both ways."""
    stub = ast.parse((SOURCES / "argil" / "_native.pyi").read_text())
    told = {}
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            told[node.name] = [a.arg for a in node.args.args]
        if isinstance(node, ast.ClassDef):
            told[node.name] = None
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    told[f"{node.name}.{member.name}"] = [a.arg for a in member.args.args]
    there = {}
    for name, value in vars(_native).items():
        if isinstance(value, type):
            there[name] = None
            if not issubclass(value, Exception):
                there.update({f"{name}.{key}": getattr(value, key) for key in vars(value)
                              if not key.startswith("_") or key == "__init__"})
        elif not name.startswith("_"):
            there[name] = value
    there.pop("Clay.__init__", None)  # made by its static functions
    assert set(told) == set(there)
    for name, parameters in told.items():
        if parameters is not None:
            signature = there[name].__doc__.splitlines()[0]
            for parameter in parameters[1:] if parameters[:1] == ["self"] else parameters:
                assert f"{parameter}: " in signature, (name, signature)


def test_the_package_says_that_it_is_typed():
    assert (SOURCES / "argil" / "py.typed").exists()
    assert len(set(argil.__all__)) == len(argil.__all__) and all(hasattr(argil, name) for name in argil.__all__)
