# SPDX-License-Identifier: BSD-3-Clause
"""references.py and columns.py on small trees: what they must find, and what not."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LONG = "word " * 20 + "word"  # 104 columns

SOUND = {
    "docs/theory.md": f"# Theory\n\n## 2. Numbers\n\n| {LONG} |\n\n    {LONG}\n\n```\n{LONG}\n```\n",
    "README.md": "[theory](docs/theory.md), `src/base/a.c`, test_limits, `cmake --build build --target docs`\n",
    "CMakeLists.txt": "add_custom_target(docs)\n",
    "src/base/a.c": f'/* docs/theory.md, section 2; (theory.md) */\nchar x[] = "docs/none.md"; /* {LONG} */\n/*\n *   {LONG}\n */\n',
    "fortran/base/a.f90": "!> theory.md, sections 2 and 2\nprint *, 'docs/none.md !'\n",
    "tests/test_limits.py": f'"""tests/test_limits.py"""\nf("""docs/none.md\n{LONG}""", "# {LONG}")\n',
}


def found_by(script, more):
    """Exit status and lines of a script on the sound tree, with more text at the ends of files."""
    with tempfile.TemporaryDirectory() as tree:
        for name in SOUND | more:
            path = Path(tree, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(SOUND.get(name, "") + more.get(name, ""), encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", Path(__file__).with_name(script), tree], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stdout.splitlines() + done.stderr.splitlines()


class Prose(unittest.TestCase):

    def finds(self, script, complaint, more):
        status, lines = found_by(script, more)
        self.assertEqual(status, 1, lines)
        self.assertIn(complaint, lines)

    def test_a_sound_tree_passes(self):
        for script in ("references.py", "columns.py"):
            status, lines = found_by(script, {})
            self.assertEqual(status, 0, lines)

    def test_references_in_a_sound_tree_are_counted(self):
        self.assertIn("11 references", found_by("references.py", {})[1])

    def test_a_missing_page_is_found(self):
        self.finds("references.py", "README.md:2: docs/none.md", {"README.md": "docs/none.md\n"})

    def test_a_missing_page_without_its_folder_is_found(self):
        self.finds("references.py", "src/base/a.c:6: none.md", {"src/base/a.c": "/* none.md */\n"})

    def test_a_missing_file_is_found_in_a_comment_of_fortran(self):
        self.finds("references.py", "fortran/base/a.f90:3: src/base/b.c", {"fortran/base/a.f90": "x = 1 ! src/base/b.c\n"})

    def test_a_missing_section_is_found(self):
        self.finds("references.py", "src/base/a.c:6: docs/theory.md, section 3", {"src/base/a.c": "/* docs/theory.md, section 3 */\n"})

    def test_the_second_of_two_sections_is_looked_for(self):
        self.finds("references.py", "README.md:2: theory.md, sections 2 and 7", {"README.md": "theory.md, sections 2 and 7\n"})

    def test_a_missing_test_and_a_missing_target_are_found(self):
        self.finds("references.py", "README.md:2: test_none", {"README.md": "test_none\n"})
        self.finds("references.py", "README.md:2: --target none", {"README.md": "--target none\n"})

    def test_a_long_line_of_a_page_is_found(self):
        self.finds("columns.py", "README.md:2: 104 columns of prose: at most 100", {"README.md": LONG + "\n"})

    def test_a_long_line_of_a_list_is_found(self):
        self.finds("columns.py", "README.md:2: 106 columns of prose: at most 100", {"README.md": f"- {LONG}\n"})

    def test_long_comments_are_found_in_every_language(self):
        self.finds("columns.py", "src/base/a.c:6: 110 columns of prose: at most 100", {"src/base/a.c": f"/* {LONG} */\n"})
        self.finds("columns.py", "fortran/base/a.f90:3: 107 columns of prose: at most 100", {"fortran/base/a.f90": f"!> {LONG}\n"})
        self.finds("columns.py", "CMakeLists.txt:2: 106 columns of prose: at most 100", {"CMakeLists.txt": f"# {LONG}\n"})
        self.finds("columns.py", "tests/test_limits.py:4: 110 columns of prose: at most 100",
                   {"tests/test_limits.py": f'"""{LONG}"""\n'})

    def test_a_hundred_columns_are_allowed(self):
        self.assertEqual(found_by("columns.py", {"README.md": LONG[:100] + "\n"})[0], 0)


if __name__ == "__main__":
    unittest.main()
