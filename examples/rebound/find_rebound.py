# SPDX-License-Identifier: BSD-3-Clause
# Prints version, library and header directory of the REBOUND that this Python has, separated by semicolons; status 1 if
# it has none. Nothing of REBOUND is run.
import glob
import importlib.metadata
import os
import sys

try:
    package = importlib.metadata.distribution("rebound")
except importlib.metadata.PackageNotFoundError:
    sys.exit(1)
site = str(package.locate_file(""))
library = glob.glob(os.path.join(site, "librebound*.so"))
if not library or not os.path.exists(os.path.join(site, "src", "rebound.h")):
    sys.exit(1)
print(package.version, library[0], os.path.join(site, "src"), sep=";")
