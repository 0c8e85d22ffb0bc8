# SPDX-License-Identifier: BSD-3-Clause
"""Makes the manual page:  manual_page.py restitute.1.in >restitute.1

Options and columns come from the command, so that --help and the page say the same. The package
restitute must be found (PYTHONPATH).
"""
import re
import sys
import textwrap

from restitute.command import parser_of, problem


def escaped(text):
    """Text for mdoc; a sentence begins a line."""
    sentences = re.sub(r"(?<=[a-z)]\.) (?=[A-Z])", "\n", text.replace("\\", "\\e")).split("\n")
    return "\n".join(re.sub(r"(?m)^([.'])", r"\\&\1", textwrap.fill(
        part, 79, break_long_words=False, break_on_hyphens=False)) for part in sentences)


def options(actions):
    """A list of options."""
    lines = [".Bl -tag -width Ds"]
    for action in actions:
        names = " , ".join(f"Fl {name[1:]}" for name in action.option_strings)
        argument = "Ar " + action.metavar.replace("|", " | ") if action.metavar else ""
        lines += [" ".join(filter(None, (".It", names, argument))),
                  escaped(action.help.replace("%%", "%") + ".")]
    return "\n".join([*lines, ".El"])


def groups(parser, title=None):
    """The options of all groups under their titles, or of one group."""
    parts = []
    for group in parser._action_groups:
        actions = [action for action in group._group_actions if action.dest != "help"]
        if title is None and group.title[0].isupper():
            parts.append(f".Ss \\&{group.title}")  # its first word may be a macro
        for action in actions:
            if isinstance(action.choices, dict):
                for name, below in action.choices.items():
                    parts += [f".Ss {parser.prog} {name}".replace("restitute ", ""), groups(below)]
        actions = [action for action in actions if action.help and not action.choices]
        if actions and title in (None, group.title):
            parts.append(options(actions))
    return "\n".join(parts)


def expanded(line):
    """A line of the template."""
    if line == "@columns":
        keys = [*(field.key for field in problem.FIELDS.values()), *problem.WORDS]
        return textwrap.fill(", ".join(keys), 68)
    found = re.fullmatch(r"@options (\w+)(?:: (.*))?", line)
    return groups(parser_of(found[1])[0], found[2]) if found else line


def main(template):
    with open(template, encoding="utf-8") as file:
        lines = file.read().rstrip().splitlines()
    del lines[1:3]  # the comment on the template
    print("\n".join(map(expanded, lines)))


if __name__ == "__main__":
    main(sys.argv[1])
