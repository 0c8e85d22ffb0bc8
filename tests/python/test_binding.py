# SPDX-License-Identifier: BSD-3-Clause
"""The binding against the C compiler: sizes, offsets, enumerators, functions, shared structs."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from restitute import _library
from restitute._library import ffi

INCLUDE = Path(os.environ.get("SOURCE_DIR", Path(__file__).parents[2])) / "include"
HEADERS = [name for name in ("core", *_library._COMPONENTS) if _library.available(name)]
TEXT = {name: (INCLUDE / "restitute" / f"{name.replace('core', 'restitute')}.h").read_text()
        for name in (*HEADERS, "status")}
ENUMS = re.findall(r"^typedef enum (restitute_\w+) \{", "\n".join(TEXT.values()), re.M)
STRUCTS = re.findall(r"^typedef struct (restitute_\w+) \{", "\n".join(TEXT.values()), re.M)


def facts():
    """What the binding says: an expression of C for each of its numbers, and its value."""
    for name in STRUCTS:
        kind = ffi.typeof(name)
        yield f"sizeof({name})", ffi.sizeof(kind)
        for member, field in kind.fields:
            yield f"offsetof({name}, {member})", field.offset
            yield f"sizeof((({name} *)0)->{member})", ffi.sizeof(field.type)
    for name in ENUMS:
        for value, word in ffi.typeof(name).elements.items():
            yield f"(long long)({word})", value


def same_types():
    """Declarations that compile only if numbers and arrays of them have the binding's types."""
    for name in STRUCTS:
        for member, field in ffi.typeof(name).fields:
            if field.type.kind in ("primitive", "array"):
                yield f"{{{ffi.getctype(field.type, '*p')} = &(({name} *)0)->{member}; (void)p;}}"


def test_every_size_offset_type_and_enumerator_is_that_of_the_compiler(tmp_path):
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if not compiler:
        pytest.skip("no C compiler here")
    known = list(facts())
    assert len(STRUCTS) >= 20 and len(ENUMS) >= 3 and len(known) > 400
    lines = [f"#include <restitute/{name.replace('core', 'restitute')}.h>" for name in HEADERS]
    lines += ["#include <stddef.h>", "#include <stdio.h>", "int main(void) {", *same_types()]
    lines += [f'printf("%lld\\n", (long long)({expression}));' for expression, _ in known]
    (tmp_path / "facts.c").write_text("\n".join([*lines, "return 0; }"]))
    subprocess.run([compiler, "-std=c11", "-Werror", f"-I{INCLUDE}", "facts.c", "-o", "facts"],
                   cwd=tmp_path, check=True)
    said = subprocess.run([tmp_path / "facts"], capture_output=True, text=True, check=True).stdout
    assert [f"{value}" for _, value in known] == said.split(), [
        (fact, c) for fact, c in zip(known, said.split()) if fact[1] != int(c)]


def functions():
    """Prototypes of the headers: names that are followed by a parenthesis, behind a since-tag."""
    for name, text in TEXT.items():
        for part in text.split("\nRESTITUTE_SINCE_0_1")[1:]:
            yield name, part.split("(")[0].split()[-1].lstrip("*")


def test_every_function_of_the_headers_is_in_its_library():
    known = list(functions())
    assert len(known) > 50
    for component, name in known:
        assert callable(getattr(getattr(_library, component), name))


@pytest.mark.parametrize("name", STRUCTS)
def test_numpy_sees_the_members_where_c_has_them(name):
    kind, dtype = ffi.typeof(name), _library.array_type(name[len("restitute_"):])
    assert dtype.itemsize == ffi.sizeof(kind)
    for member, field in kind.fields:
        assert dtype.fields[member][1] == field.offset
        assert dtype.fields[member][0].itemsize == ffi.sizeof(field.type)


def test_records_of_numpy_are_structs_of_c_with_their_defaults():
    scenes = _library.structs("scene", 3)
    scenes["friction"] = [0.1, 0.2, 0.3]
    there = _library.pointer(scenes, "restitute_scene[]")
    assert [there[i].friction for i in range(3)] == [0.1, 0.2, 0.3]
    assert (scenes["radius2"] == np.inf).all()
    assert (scenes["struct_size"] == ffi.sizeof(there[0])).all()
    there[1].normal_speed = 7
    assert scenes["normal_speed"].tolist() == [0, 7, 0]


def test_a_failed_call_is_an_exception_with_its_status():
    handle = ffi.new("restitute_material **")
    with pytest.raises(ValueError, match="^modulus .* = -1") as caught:
        _library.call(_library.core.restitute_material_elastic, -1.0, 0.5, handle)
    assert caught.value.status == _library.core.RESTITUTE_ERROR_DOMAIN
