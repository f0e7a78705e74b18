#!/usr/bin/env python3
"""The recipe for Spack, without Spack: it fetches this checkout, and every option that it sets is one of the build."""

import os
import pathlib
import re
import sys
import types
import unittest
from unittest import mock

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]).resolve()
RECIPE = ROOT / "packaging" / "spack" / "spack_repo" / "railwave" / "packages" / "railwave" / "package.py"


class CMakePackage:
    """As much of Spack's as the recipe's options need; all variants are on."""

    spec = mock.MagicMock()

    def define(self, option, value):
        return option

    def define_from_variant(self, option, variant):
        return option


def nothing(*_, **__):
    pass


def modules():
    """Stand-ins of what the recipe imports."""
    directives = ("license", "version", "variant", "depends_on", "extends")
    package = types.SimpleNamespace(**dict.fromkeys(directives, nothing), python_platlib="lib/python")
    package.__all__ = [*directives, "python_platlib"]
    build = types.SimpleNamespace(CMakePackage=CMakePackage, generator=nothing)
    return {"spack": mock.Mock(), "spack.package": package, "spack_repo": mock.Mock(),
            "spack_repo.builtin": mock.Mock(), "spack_repo.builtin.build_systems": mock.Mock(),
            "spack_repo.builtin.build_systems.cmake": build}


class Recipe(unittest.TestCase):
    def setUp(self):
        names = {"__file__": str(RECIPE), "__name__": "package"}
        with mock.patch.dict(sys.modules, modules()):
            exec(compile(RECIPE.read_text(encoding="utf-8"), RECIPE, "exec"), names)
        self.package = names["Railwave"]

    def test_fetches_this_checkout(self):
        self.assertEqual(self.package.git, ROOT.as_uri())

    def test_options_are_of_the_build(self):
        files = [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake"), ROOT / "python" / "CMakeLists.txt"]
        known = set(re.findall(r"(?:option|set)\((\w+)", "\n".join(file.read_text("utf-8") for file in files)))
        options = self.package().cmake_args()
        self.assertGreater(len(options), 5)
        self.assertLessEqual(set(options), known)


if __name__ == "__main__":
    unittest.main()
