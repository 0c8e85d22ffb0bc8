# SPDX-License-Identifier: BSD-3-Clause
"""Prints where under a prefix this Python looks for packages: find_packages.py PREFIX.

Debian's Python looks into dist-packages under /usr and /usr/local, into site-packages under others.
The prefix may be a copy of the root that a package is made from: its end tells what it stands for.
"""

import os
import sys
import sysconfig

prefix = os.path.normpath(sys.argv[1])
scheme, base = "posix_prefix", prefix
if "deb_system" in sysconfig.get_scheme_names():
    if prefix.endswith("/usr"):
        scheme = "deb_system"
    elif prefix.endswith("/usr/local"):
        scheme, base = "posix_local", os.path.dirname(prefix)
found = sysconfig.get_path("purelib", scheme, vars={"base": base, "platbase": base})
print(os.path.relpath(found, prefix))
