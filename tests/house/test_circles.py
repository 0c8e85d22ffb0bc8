# SPDX-License-Identifier: BSD-3-Clause
"""circles.py on small trees, one with each kind of circle, one with none: what it must find, and
what not."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("circles.py")

SOUND = {
    "src/base/status.h": "int rst_one(void);\n",
    "src/base/status.c": '#include "base/status.h"\nint rst_one(void)\n{\n    return 1;\n}\n',
    "src/table/form.h": '#include "base/status.h"\nint rst_two(void);\n',
    "src/table/form.c": '#include "table/form.h"\nint rst_two(void)\n{\n    return rst_one();\n}\n',
    "src/fit/search.c": '#include "fit/options.h"\n#include "table/form.h"\n',
    "src/fit/options.h": "",
    "fortran/common/precision.f90": "module rst_precision\nend module rst_precision\n",
    "fortran/euler/euler.f90": "module rst_euler\n  use rst_precision, only: dp\nend module rst_euler\n",
}


def found_in(more):
    """Exit status and lines of circles.py on the sound tree with more in it: {file: text behind
    what is there}."""
    with tempfile.TemporaryDirectory() as tree:
        for name in SOUND | more:
            path = Path(tree, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(SOUND.get(name, "") + more.get(name, ""), encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, tree], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines()


class Circles(unittest.TestCase):

    def finds(self, complaint, more):
        status, lines = found_in(more)
        self.assertEqual(status, 1)
        self.assertIn(complaint, lines)

    def test_a_tree_without_circles_passes(self):
        status, lines = found_in({})
        self.assertEqual(status, 0, lines)
        self.assertFalse([line for line in lines if "circle" in line])

    def test_a_name_in_a_comment_is_no_call(self):
        self.assertEqual(found_in({"src/base/status.c": "/* called by rst_two() of\n * form.c */\n"})[0], 0)

    def test_includes_of_two_files_in_a_circle_are_found(self):
        self.finds("a circle of includes between files: table/form, table/panel",
                   {"src/table/panel.h": '#include "table/form.h"\n', "src/table/form.c": '#include "table/panel.h"\n'})

    def test_includes_of_three_files_in_a_circle_are_found(self):
        self.finds("a circle of includes between files: io/a, io/b, io/c",
                   {"src/io/a.h": '#include "io/b.h"\n', "src/io/b.h": '#include "io/c.h"\n', "src/io/c.h": '#include "io/a.h"\n'})

    def test_calls_in_a_circle_behind_one_header_are_found(self):
        self.finds("a circle of calls between files: table/form, table/solve",
                   {"src/table/form.c": "int rst_three(void)\n{\n    return rst_four();\n}\n",
                    "src/table/solve.c": "int rst_four(void)\n{\n    return rst_two();\n}\n"})

    def test_includes_of_two_folders_in_a_circle_are_found_though_their_files_make_none(self):
        self.finds("a circle of arrows between folders of src: base, table",
                   {"src/base/scene.c": '#include "table/axis.h"\n', "src/table/axis.h": ""})

    def test_a_call_that_makes_a_circle_of_folders_is_found(self):
        self.finds("a circle of arrows between folders of src: base, table",
                   {"src/base/scene.c": "int rst_five(void)\n{\n    return rst_two();\n}\n"})

    def test_a_component_may_not_need_one_that_needs_it(self):
        self.finds("a circle of arrows between folders of src: fit, table", {"src/table/axis.h": '#include "fit/options.h"\n'})

    def test_an_include_without_its_folder_is_found(self):
        self.finds("table/axis.h: no file form.h in src", {"src/table/axis.h": '#include "form.h"\n'})

    def test_uses_of_folders_in_a_circle_are_found(self):
        self.finds("a circle of uses between folders of fortran: common, euler",
                   {"fortran/common/series.f90": "module rst_series\n  use rst_euler, only: step\nend module rst_series\n"})

    def test_uses_of_modules_in_a_circle_are_found(self):
        self.finds("a circle of uses between files: common/precision.f90, euler/euler.f90",
                   {"fortran/common/precision.f90": "  USE rst_euler, only: step\n"})


if __name__ == "__main__":
    unittest.main()
