# SPDX-License-Identifier: BSD-3-Clause
# Where the energy of soft_sphere.csv goes:  gnuplot soft_sphere.gp
if (!exists("table")) table = 'soft_sphere.csv'
if (!exists("figure")) figure = 'soft_sphere.svg'
set terminal svg size 720,420 font 'Helvetica,13' background 'white'
set output figure
set datafile separator ','
set xlabel 'time (s)'
set ylabel 'energy (mJ)'
set key outside right top reverse Left
set style fill solid noborder
set yrange [0:*]
set title 'Rubber spheres drop into a box'
p(n) = 1e3*column(n)
plot table skip 1 using 1:(p(2)+p(3)+p(4)+p(5)+p(6)) with filledcurves y1=0 lc rgb '#d9d9d9' title 'lost in dashpots', \
     '' skip 1 using 1:(p(2)+p(3)+p(4)+p(5)) with filledcurves y1=0 lc rgb '#a6a6a6' title 'lost to friction', \
     '' skip 1 using 1:(p(2)+p(3)+p(4)) with filledcurves y1=0 lc rgb '#5b8db8' title 'stored in contacts', \
     '' skip 1 using 1:(p(2)+p(3)) with filledcurves y1=0 lc rgb '#f0c060' title 'of motion', \
     '' skip 1 using 1:(p(3)) with filledcurves y1=0 lc rgb '#3f3f3f' title 'of height'
