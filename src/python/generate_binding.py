# SPDX-License-Identifier: BSD-3-Clause
"""Writes the binding of the package from the public headers, so that nothing is typed twice.

    generate_binding.py COMPILER INCLUDE_DIRECTORY OUTPUT HEADER...

The C compiler expands the headers; cffi reads what is left (its out-of-line ABI mode) and writes a
Python module with every struct, enum and prototype. Run by CMake.
"""
import re
import subprocess
import sys

import cffi


def declarations(compiler, include, headers):
    """The C of the headers as cffi reads it: no includes of the system, no inline functions."""
    source = "".join(f"#include <restitute/{header}.h>\n" for header in headers)
    command = [*compiler.split(), "-E", "-P", f"-I{include}", "-D__attribute__(x)=", "-"]
    text = subprocess.run(command, input=source, capture_output=True, text=True, check=True).stdout
    text = text[text.index("typedef enum restitute_status"):]
    text = re.sub(r"static inline [^{]*\{[^}]*\}", "", text)
    return re.sub(r"= \((-?\d+)\)", r"= \1", text)


def main():
    compiler, include, output, *headers = sys.argv[1:]
    ffi = cffi.FFI()
    ffi.set_source("restitute._binding", None)
    ffi.cdef(declarations(compiler, include, headers))
    ffi.emit_python_code(output)


if __name__ == "__main__":
    main()
