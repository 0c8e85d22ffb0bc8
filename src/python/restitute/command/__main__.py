# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m restitute.command"""
import sys

from restitute.command import main

if __name__ == "__main__":
    sys.exit(main())
