# SPDX-License-Identifier: GPL-2.0-or-later
# A hopper with both laws, from the files of hopper.py:
#   gnuplot -e "figure='hopper.png'" hopper.gp
set terminal pngcairo size 1000,640 font "Helvetica,12" background "white"
set output figure
opened = 4.5 * sqrt(0.03 / 9.81)
set multiplot

# The rear half of the beads, and the walls cut through the axis
set style fill solid border lc rgb "#404040"
set palette defined (0 "#1f6f8b", 0.35 "#8fc1a9", 0.6 "#f2c14e", 1 "#c4451c")
set cbrange [0:0.9]
unset colorbox
unset border
unset tics
set xrange [-1.05:1.05]
set yrange [-0.65:1.05]
set size ratio -1
tan30 = tan(pi / 6)
set arrow from -0.45,0 to -0.9,0.45/tan30 nohead lw 2
set arrow from 0.45,0 to 0.9,0.45/tan30 nohead lw 2
set arrow from -0.9,1 to -0.9,-0.6 nohead lw 2
set arrow from -0.9,-0.6 to 0.9,-0.6 nohead lw 2
set arrow from 0.9,-0.6 to 0.9,1 nohead lw 2
titles = "'restitute, full' 'restitute, flowing' 'constant damping, flowing' 'restitute, at rest'"
do for [k = 0:3] {
    set origin 0.25 * k, 0.56
    set size 0.25, 0.43
    set lmargin 0; set rmargin 0; set bmargin 0; set tmargin 2
    set title word(titles, k + 1)
    plot "hopper-frames.txt" index k using 1:2:3:4 with circles fc palette notitle
}
reset
set style line 1 lc rgb "#1f6f8b" lw 2.5
set style line 3 lc rgb "#c4451c" lw 2 dt 2
set grid lc rgb "#dddddd" lw 1
set xlabel "time from the opening of the outlet, s"
set size 0.5, 0.55
set origin 0, 0
set xrange [0:*]
set yrange [0:1]
set ylabel "discharged mass over all"
set key bottom right
plot "hopper-restitute.txt" using ($1 - opened):($4 / $3) with lines ls 1 title "restitute", \
     "hopper-granular.txt" using ($1 - opened):($4 / $3) with lines ls 3 title "constant damping"
set origin 0.5, 0
set xrange [-0.25:*]
set yrange [1e-7:3e-3]
set logscale y
set format y "10^{%T}"
set ylabel "kinetic energy, J"
plot "hopper-restitute.txt" using ($1 - opened):5 with lines ls 1 title "restitute", \
     "hopper-granular.txt" using ($1 - opened):5 with lines ls 3 title "constant damping"
unset multiplot
