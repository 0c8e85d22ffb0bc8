# SPDX-License-Identifier: GPL-2.0-or-later
# The mantle of a drum around the y axis as a mesh in STL:  awk -v radius=0.08 -v depth=0.04 -v facets=48 -f drum.awk
function corner(k, y)
{
    printf "vertex %.9f %.9f %.9f\n", radius * cos(2 * pi * k / facets), y, radius * sin(2 * pi * k / facets)
}
function triangle(k1, y1, k2, y2, k3, y3)
{
    print "facet normal 0 0 0\nouter loop"
    corner(k1, y1)
    corner(k2, y2)
    corner(k3, y3)
    print "endloop\nendfacet"
}
BEGIN {
    pi = atan2(0, -1)
    print "solid drum"
    for (k = 0; k < facets; k++) {
        triangle(k, 0, k + 1, 0, k + 1, depth)
        triangle(k, 0, k + 1, depth, k, depth)
    }
    print "endsolid drum"
}
