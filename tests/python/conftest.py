# SPDX-License-Identifier: BSD-3-Clause
"""What all tests of the package share. A warning that no test expects is an error (pyproject.toml).

A test that needs a component of the library beside core, or a package beside NumPy:

    @pytest.mark.component("fit")
    def ...

    h5py = pytest.importorskip("h5py")
"""

import pytest

from restitute import _library


def pytest_runtest_setup(item):
    for marker in item.iter_markers("component"):
        for name in marker.args:
            if not _library.available(name):
                pytest.skip(f"the component {name} is not in this build")


def pytest_terminal_summary(terminalreporter):
    """Reasons of skipped tests in lines that tests/run repeats."""
    reasons = {report.longrepr[2] for report in terminalreporter.getreports("skipped")}
    for reason in sorted(reasons):
        terminalreporter.write_line("skipped: " + reason.replace("Skipped: ", ""))
