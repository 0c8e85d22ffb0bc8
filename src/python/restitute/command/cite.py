# SPDX-License-Identifier: BSD-3-Clause
"""`restitute cite`: the paper, this software, the sources of materials."""
from restitute.command import options, problem
from restitute.command.options import emit, shown

_EPILOG = """Examples:
  restitute cite
  restitute cite polyisobutylene rubber.json
  restitute cite --format bibtex >restitute.bib
"""


def add(subparsers):
    """The parser of `restitute cite`."""
    parser = subparsers.add_parser("cite", epilog=_EPILOG,
                                   usage="restitute cite [MATERIAL...] [OPTION...]")
    parser.add_argument("material", nargs="*", metavar="MATERIAL",
                        help="names of materials or their files, whose sources are named, too")
    options.add(parser, "format", "text|bibtex", "default text", options.one_of("text", "bibtex"))


def run(arguments):
    """Print what to cite."""
    import restitute

    words = [problem.read_material(word, "material") for word in arguments.material]
    text = restitute.cite(*words, bibtex=arguments.format == "bibtex")
    emit("".join(shown(line) + "\n" for line in text.splitlines()))
    return 0
