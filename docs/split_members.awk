# SPDX-License-Identifier: BSD-3-Clause
# Filter for Doxygen: gives every member of `double a, b; /**< text */` the text, which Doxygen would give to b alone. And a
# reference that ends in a colon, `@ref name:`, becomes `#name:`, which it can resolve. Line numbers stay.
{
    while (match($0, /@ref [a-z_]+:/))
        $0 = substr($0, 1, RSTART - 1) "#" substr($0, RSTART + 5)
}
/^ +(double|int64_t) [a-z0-9_, ]+, [a-z0-9_, ]+;.*\/\*\*</ {
    held = $0
    lines = 0
    while (held !~ /\*\/ *$/ && (getline more) > 0) {
        sub(/^ +/, " ", more)
        held = held more
        lines++
    }
    text = substr(held, index(held, "/**<"))
    declaration = substr(held, 1, index(held, ";") - 1)
    match(declaration, /^ +[a-z0-9_]+ /)
    type = substr(declaration, 1, RLENGTH)
    count = split(substr(declaration, RLENGTH + 1), names, / *, */)
    for (i = 1; i <= count; i++)
        printf "%s%s; %s ", type, names[i], text
    for (i = 0; i <= lines; i++)
        print ""
    next
}
{ print }
