#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What to cite: the paper and the software as CITATION.cff has them, and the sources of materials.
. "$(dirname -- "$0")/common.sh"

doi=$(sed -n 's/^ *doi: //p' "$SOURCE_DIR/CITATION.cff")
[ -n "$doi" ] || fail "CITATION.cff has no DOI"
title=$(sed -n 's/^  title: "\(.*\)"$/\1/p' "$SOURCE_DIR/CITATION.cff")
version=$(sed -n 's/^version: //p' "$SOURCE_DIR/CITATION.cff")

expect 0 cite
tr '\n' ' ' <out | tr -s ' ' >line
has line "$doi" "$title" "version $version," Willert Kusche Popov

# The source of each material is named, by name and from a file.
expect 0 cite steel "$materials/polyisobutylene.json"
has out 'Structural steel' 'EN 1993-1-1' 'Catsiff & Tobolsky'
printf '{"name": "x", "poisson_ratio": 0.5, "model": "elastic", "modulus_pa": 1}' >m.json
expect 0 cite m.json
has out 'The material x:' 'no source is named'

expect 0 cite --format bibtex steel
has out '@article{' "doi = {$doi}" '@misc{' '% The material Structural steel: EN 1993-1-1'
[ "$(tr -dc '{' <out | wc -c)" -eq "$(tr -dc '}' <out | wc -c)" ] || fail "braces are not balanced"

refused 'did you mean steel?' cite steal
refused 'must be text or bibtex' cite --format ris
