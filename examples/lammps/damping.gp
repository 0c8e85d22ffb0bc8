# SPDX-License-Identifier: GPL-2.0-or-later
# Restitution over speed and angle, from the table of damping.py:
#   gnuplot -e "table='damping.csv'; figure='damping.svg'" damping.gp
set terminal svg size 1000,460 font "Helvetica,14" background "white"
set output figure
set datafile separator ","
set grid lc rgb "#dddddd" lw 1
set border lw 1
set style line 1 lc rgb "#1f6f8b" lw 2.5
set style line 2 lc rgb "#1f6f8b" lw 2 pt 6 ps 0.8
set style line 3 lc rgb "#c4451c" lw 2 dt 2
set style line 4 lc rgb "#5b8c2a" lw 2.5
set style line 5 lc rgb "#5b8c2a" lw 2 pt 4 ps 0.7
set multiplot layout 1,2
set logscale x
set format x "10^{%T}"
set xlabel "speed of a head-on impact, m/s"
set ylabel "normal restitution e_z"
set yrange [0:1]
set key top right samplen 2
plot table every ::1 index 0 using 1:3 with lines ls 1 title "restitute, method sync", \
     table every ::1 index 0 using 1:5 with points ls 2 title "LAMMPS, pair\\_style restitute", \
     table every ::1 index 0 using 1:7 with lines ls 3 title "LAMMPS, tsuji fitted at 1 m/s"
unset logscale x
set format x "%g"
set xlabel "angle between velocity and normal, degrees"
set ylabel "tangential restitution e_x"
set xrange [0:90]
set yrange [-1:0.5]
set key bottom left Left reverse samplen 1.5
plot table index 1 using ($1 < 0.01 ? $2 : NaN):4 with lines ls 1 title "1 mm/s, sync", \
     table index 1 using ($1 < 0.01 ? $2 : NaN):6 with points ls 2 title "1 mm/s, LAMMPS", \
     table index 1 using ($1 > 0.01 ? $2 : NaN):4 with lines ls 4 title "0.1 m/s, sync", \
     table index 1 using ($1 > 0.01 ? $2 : NaN):6 with points ls 5 title "0.1 m/s, LAMMPS", \
     table index 1 using ($1 < 0.01 ? $2 : NaN):8 with lines ls 3 title "tsuji, any speed"
unset multiplot
