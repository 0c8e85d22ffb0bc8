#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Case files that are no case files: refused with exit status 2 and the line, and nothing is
# written.
. "$(dirname -- "$0")/common.sh"

bad() {
    printf "$1" >cases.csv
    shift
    refused "$@" pair --input cases.csv --output out.csv
    absent out.csv out.csv.meta.json out.csv.partial out.csv.partial.json
}
bad '' 'cases.csv: is empty'
bad '\n\n' 'cases.csv: is empty'
bad '# only a comment\n' 'cases.csv: is empty'
bad 'psi,delta1\n' 'has column names but no rows'
bad 'psi,delta1\n1,0\n1\n' 'cases.csv line 3: 1 cells, but the header has 2 columns'
bad 'psi,delta1\n1,0,5\n' 'cases.csv line 2: 3 cells, but the header has 2 columns'
bad 'psi,Delta-1\n1,0\n' 'unknown column "Delta-1"; did you mean delta1?'
bad 'speed,angle\n1,0\n' 'unknown column "speed"; did you mean speed_m_s?'
bad 'psi,ez\n1,0\n' 'column ez has the name of a result'
bad 'radius1_m,radius_m\n1,1\n' 'columns radius1_m and radius_m are the same'
bad 'psi;delta1\n1,5;0\n' 'line 1: the cells are separated by semicolons'
bad 'psi\tdelta1\n1\t0\n' 'line 1: the cells are separated by tabs'
bad 'psi,delta1\n1,5,0,1\n' 'line 2: 4 cells, but the header has 2 columns; decimal commas?'
bad '\377\376p\000s\000' 'is UTF-16'
bad 'psi\n1\n\000\n' 'cases.csv line 3: a NUL byte'
bad 'psi,psi\n1,0\n' 'column psi appears twice'
bad 'psi,\n1,0\n' 'column 2 has no name'
bad 'psi,delta1\n1,"0\n' 'never closed'
bad 'psi,delta1\n1,0"\n' 'cases.csv line 2: a stray quote'
bad 'psi,ball\n1,a\n2,5" steel\n3\n' 'cases.csv line 3: a stray quote'
bad 'psi,ball\n1,a\n2,"5"" steel\n3,b\n4,c\n' 'cases.csv line 3: a quote is never closed'
bad 'psi,ball\n1,a\n2,"b\n3,c"d\n' 'cases.csv lines 3 to 4, which a quote joins: text behind the quote'
bad 'psi,radius1_m\n1,1\n' 'use one kind'
bad 'delta1,gamma\n1,1\n' 'psi is missing'
bad 'psi,delta1,gamma,delta2\n1,1,1,1\n' 'two of them determine the third'
bad 'radius1_m,speed_m_s,friction\n1,1,1\n' 'material is missing'

refused 'no-such-file.csv: cannot be read' pair --input no-such-file.csv --output out.csv
mkdir folder
refused 'folder: cannot be read' pair --input folder --output out.csv
printf 'psi\n1\n' >cases.csv
refused 'cannot be written' pair --input cases.csv --output missing/out.csv
refused 'is not a regular file' pair --input cases.csv --output folder
printf 'radius1_m,speed_m_s,friction,density1_kg_m3\n1,1,1,1\n' >cases.csv
refused 'none.json: cannot be read' pair --input cases.csv --output out.csv --material none.json
if [ -d /proc/self ]; then
    refused '/proc/out.csv: cannot be written: no file can be made in this folder' \
        pair --input cases.csv --output /proc/out.csv --material $materials/steel.json
fi
absent out.csv out.csv.meta.json out.csv.partial out.csv.partial.json
