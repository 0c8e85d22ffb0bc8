# SPDX-License-Identifier: BSD-3-Clause
# Prints library and header directory of the REBOUND that this Python has, separated by a semicolon.
# If it has none that fits, status 1 and on standard error what is wrong. Nothing of REBOUND is run.
import glob
import importlib.metadata
import os
import sys

try:
    package = importlib.metadata.distribution("rebound")
except importlib.metadata.PackageNotFoundError:
    sys.exit("rebound is not installed in " + sys.executable)
if not package.version.startswith("5."):  # the interface in C changes between major versions
    sys.exit(f"rebound {package.version} is installed in {sys.executable}, but 5 is needed")
site = str(package.locate_file(""))
library = glob.glob(os.path.join(site, "librebound*.so"))
headers = os.path.join(site, "src")
if not library or not os.path.exists(os.path.join(headers, "rebound.h")):
    sys.exit(f"rebound {package.version} is installed in {sys.executable}, but without its C library or header")
print(library[0], headers, sep=";")
