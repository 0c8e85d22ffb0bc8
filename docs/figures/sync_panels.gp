# SPDX-License-Identifier: BSD-3-Clause
# The figure of docs/sync.md from what `sync_panels` prints: gnuplot -e "curves='DIR';
# figures='DIR'" sync_panels.gp
set terminal svg size 720,460 font "Helvetica,14" background "white"
set output figures."/sync-panels.svg"
set border lw 1
set xlabel "time s"
set ylabel "radius X"
set xrange [0:3.35]
set yrange [0:1.02]
set key right top spacing 1.25 samplen 2
set label 1 "stick" at 1.05,0.3 center textcolor rgb "#1f6f8b"
set label 2 "slip" at 1.82,0.66 center textcolor rgb "#c4451c"
set label 4 "stick ends" at 2.2,0.04 right textcolor rgb "#c4451c"
set label 5 "slip begins" at 1.02,0.955 right textcolor rgb "#c4451c"
set label 3 "no contact" at 0.1,0.75 left textcolor rgb "#888888"
plot curves."/sync_curves.dat" using 1:3:2 with filledcurves lc rgb "#f6dfd6" notitle, \
     curves."/sync_angles.dat" using 1:2 with lines lc rgb "#999999" lw 1 dt 2 title "same edge angle", \
     curves."/sync_curves.dat" using 1:2 with lines lc rgb "#333333" lw 2 title "edge A(s)", \
     curves."/sync_curves.dat" using 1:3 with lines lc rgb "#c4451c" lw 2.5 title "stick radius c(s)", \
     curves."/sync_points.dat" using 1:2 with points pt 7 ps 0.5 lc rgb "#1f6f8b" title "points of collocation", \
     curves."/sync_points.dat" using 1:($3 > 0 ? $2 : NaN) with points pt 6 ps 1.1 lw 1.5 lc rgb "#1f6f8b" title "ends of panels"
