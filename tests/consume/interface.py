# SPDX-License-Identifier: BSD-3-Clause
"""Compares public headers with Fortran modules: interface.py CC INCLUDE SOURCES COMPONENT...

INCLUDE holds the headers, SOURCES the modules. It says what differs of names and arguments of
functions, and of names of structs and constants. It writes layout.c and layout.f90, which print
sizes, offsets and values for interface.sh to compare.
"""
import pathlib
import re
import subprocess
import sys

SCALARS = {"double": "real(c_double)", "int": "integer(c_int)", "size_t": "integer(c_size_t)",
           "int64_t": "integer(c_int64_t)", "uint64_t": "integer(c_int64_t)", "char": "character(kind=c_char)"}


class Header:
    """What a header declares, as the C preprocessor shows it."""

    def __init__(self, cc, include, component):
        command = [cc, "-E", "-P", f"-I{include}", f"{include}/restitute/{component}.h"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        exported = r'__attribute__\s*\(\(visibility\("default"\)\)\)\s*(\w[\w\s]*?[\s*]+)(restitute_\w+)\s*\(([^;]*?)\)\s*;'
        self.functions = {name: (squeezed(kind), [squeezed(a) for a in arguments.split(",") if a.strip() != "void"])
                          for kind, name, arguments in re.findall(exported, text)}
        enums = re.findall(r"\benum\b[^{;]*\{([^}]*)\}", text)
        self.constants = re.findall(r"\bRESTITUTE_\w+", " ".join(enums))
        structs = re.findall(r"typedef struct restitute_\w+ \{(.*?)\} (restitute_\w+);", text, re.S)
        self.structs = {name: members(body) for body, name in structs}


def squeezed(text):
    return " ".join(text.replace("*", " * ").split())


def members(body):
    """(type, name) of each member; the type of what is a pointer ends with '*'."""
    found = []
    for declaration in filter(None, map(squeezed, body.split(";"))):
        if "(" in declaration:
            found.append(("function *", re.search(r"\( \* (\w+) ?\)", declaration)[1]))
            continue
        kind, rest = re.match(r"(?:const )?(\w+) (.*)", declaration).groups()
        for name in rest.split(","):
            found.append((kind + " *" * name.count("*"), re.search(r"\w+", name)[0]))
    return found


def bindings(source):
    """C name -> (result, arguments, {argument: (type, attributes)}) of what a module binds to C."""
    text = re.sub(r" *& *\n *", " ", re.sub(r"!.*", "", source))
    body = re.compile(r"^ *(?:pure )?([^\n]*?) ?\b(?:function|subroutine) \w+\(([^)]*)\) bind\(c, name=\"(restitute_\w+)\"\)(.*?)"
                      r"^ *end ", re.M | re.S)
    found = {}
    for result, arguments, name, declarations in body.findall(text):
        types = {}
        for left, right in re.findall(r"^ *(\S.*?) :: (.*)$", declarations, re.M):
            kind, *attributes = re.split(r", (?![^(]*\))", left)
            for argument in re.findall(r"(\w+)(?:\([^)]*\))?", right):
                types[argument] = (kind, attributes)
        found[name] = (result, re.findall(r"\w+", arguments), types)
    return found


def expected(argument, structs):
    """Possible Fortran types of an argument in C; is it passed by value, and is it constant?"""
    constant = argument.startswith("const ") or "* const *" in argument
    kind = re.sub(r"\bconst\b ?", "", argument)
    stars = kind.count("*") + kind.count("[")
    kind = kind.split()[0]
    if stars == 0:
        return [SCALARS.get(kind, "type(c_funptr)")], True, True
    if kind == "void" or stars == 1 and kind.startswith("restitute_") and kind not in structs:
        return ["type(c_ptr)"], True, True
    return [SCALARS.get(kind, f"type({kind})")] + ["type(c_ptr)"] * (stars == 2), False, constant


def compare(name, prototype, binding, structs):
    """What is wrong of a function: a line each."""
    kind, arguments = prototype
    result, names, types = binding
    results = {"void": "", "const char *": "type(c_ptr)", "const restitute_method *": "type(c_ptr)"}
    if result != results.get(kind, SCALARS.get(kind)):
        yield f"{name}: C returns {kind}, Fortran {result or 'nothing'}"
    c_names = [re.search(r"(\w+)(?: ?\[.*)?$", a)[1] for a in arguments]
    if c_names != names:
        yield f"{name}: arguments are {c_names} in C, {names} in Fortran"
        return
    for argument, text in zip(names, arguments):
        possible, by_value, constant = expected(text, structs)
        kind, attributes = types[argument]
        if kind not in possible or by_value != ("value" in attributes):
            yield f"{name}: {argument} is '{text}' in C, '{', '.join([kind] + attributes)}' in Fortran"
        if not by_value and constant != ("intent(in)" in attributes):
            yield f"{name}: {argument} is '{text}' in C, which {'is' if constant else 'is not'} intent(in)"


def write_layouts(parts, structs):
    """Programs in C and Fortran that print the same lines if the two agree."""
    c = ["#include <stdio.h>", "#include <stddef.h>"] + [f"#include <restitute/{p}.h>" for p in parts]
    c += ["#define MEMBER(s, m) printf(#s \".\" #m \" %zu %zu\\n\", offsetof(s, m), sizeof((s *)0)->m)", "int main(void)", "{"]
    f = ["program layout", "use, intrinsic :: iso_c_binding"]
    for part, header in parts.items():
        module = "restitute" if part == "restitute" else f"restitute_{part}_module"
        functions = [n for n in header.functions if not n.endswith("_init_sized")]
        f += [f"use {module}, only: {n}" for n in functions + list(header.structs) + header.constants]
    f += ["implicit none (type, external)"]
    f += [f"call put_{s}()" for s in structs]
    for header in parts.values():
        for k in header.constants:
            c += [f"printf(\"{k} %d\\n\", {k});"]
            f += [f'print "(a, i0)", "{k} ", {k}']
    f += ["contains"]
    for kind in ["double", "int", "size_t", "char"]:  # a member of another type does not compile
        f += [f"elemental subroutine is_{kind}(x)", f"{SCALARS[kind]}, intent(in) :: x", "end subroutine"]
    f += ["subroutine put(name, start, member, bytes)", "character(len=*), intent(in) :: name",
          "type(c_ptr), intent(in) :: start, member", "integer(c_size_t), intent(in) :: bytes",
          'print "(a, 2(1x, i0))", name, transfer(member, 0_c_intptr_t) - transfer(start, 0_c_intptr_t), bytes',
          "end subroutine"]
    for struct, its_members in structs.items():
        c += [f'printf("{struct} %zu\\n", sizeof({struct}));']
        f += [f"subroutine put_{struct}()", f"type({struct}), target :: x", f'print "(a, i0)", "{struct} ", c_sizeof(x)']
        for kind, name in its_members:
            kind = kind.replace("uint64_t", "size_t").replace("int64_t", "size_t")
            c += [f"MEMBER({struct}, {name});"]
            f += [f"call is_{kind}(x%{name})"] * (kind in SCALARS)
            f += [f'call put("{struct}.{name}", c_loc(x), &', f'c_loc(x%{name}), c_sizeof(x%{name}))']
        f += ["end subroutine"]
    pathlib.Path("layout.c").write_text("\n".join(c + ["return 0;", "}", ""]))
    pathlib.Path("layout.f90").write_text("\n".join(f + ["end program", ""]))


def main(cc, include, sources, *components):
    parts = {component: Header(cc, include, component) for component in ("restitute",) + components}
    known = {}
    for part, header in parts.items():  # a header includes those it stands on
        for kind in (header.functions, header.structs):
            for name in known.keys() & kind.keys() if part != "restitute" else ():
                del kind[name]
        header.constants = [k for k in header.constants if k not in known]
        known.update(header.functions, **header.structs, **dict.fromkeys(header.constants))
    structs = {name: m for header in parts.values() for name, m in header.structs.items()}
    files = [f"restitute_{c}.f90" for c in ("types", "core") + components]
    source = "\n".join(pathlib.Path(sources, file).read_text() for file in files)
    functions = {name: f for header in parts.values() for name, f in header.functions.items()}
    bound = bindings(source)
    constants = {k for header in parts.values() for k in header.constants}
    wrong = []
    handle = r"(?!\n *type\(c_ptr\) :: address)"
    for in_c, here in [(functions, bound), (constants, re.findall(r"\bRESTITUTE_\w+(?= = )", source)),
                       (structs, re.findall(r"type, bind\(c\) :: (restitute_\w+)$" + handle, source, re.M))]:
        wrong += [f"{name}: in C alone" for name in sorted(set(in_c) - set(here))]
        wrong += [f"{name}: in Fortran alone" for name in sorted(set(here) - set(in_c))]
    for name in sorted(functions.keys() & bound.keys()):
        wrong += compare(name, functions[name], bound[name], structs)
        struct = name.removesuffix("_init_sized")
        if struct != name and not re.search(rf"^ *interface {struct}$", source, re.M):
            wrong.append(f"{struct}: no constructor in Fortran")
    write_layouts(parts, structs)
    print(f"{len(functions)} functions, {len(structs)} structs and {len(constants)} constants")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
