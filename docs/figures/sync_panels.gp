# SPDX-License-Identifier: BSD-3-Clause
# The figure of docs/sync.md from what `sync_panels` prints: gnuplot -e "curves='DIR';
# figures='DIR'" sync_panels.gp
set terminal svg size 720,460 font "Helvetica,14" background "white"
set output figures."/sync-panels.svg"
set border lw 1
set xlabel "time s"
set ylabel "radius X"
set xrange [0:3.5]
set yrange [0:1.12]
set key right top spacing 1.25 samplen 2
set arrow 1 from 1.245,0 to 1.245,1.05 nohead dt 3 lc rgb "#888888"
set label 1 "all stick" at 0.98,0.4 center textcolor rgb "#1f6f8b"
set label 2 "gross slip" at 0.42,0.3 center textcolor rgb "#c4451c"
set label 3 "slip zone" at 1.98,0.62 center front textcolor rgb "#c4451c"
set label 4 "stick ends" at 2.02,0.06 right textcolor rgb "#c4451c"
set label 5 "slip begins" at 1.05,0.94 right textcolor rgb "#c4451c"
set label 6 "stick begins" at 0.7,0.86 right textcolor rgb "#1f6f8b"
set label 7 "compression" at 1.22,1.06 right textcolor rgb "#888888"
set label 8 "restitution" at 1.27,1.06 left textcolor rgb "#888888"
set label 9 "stick zone" at 1.6,0.3 center textcolor rgb "#1f6f8b"
plot curves."/sync_curves.dat" using 1:3:2 with filledcurves lc rgb "#f6dfd6" notitle, \
     curves."/sync_angles.dat" using 1:2 with lines lc rgb "#999999" lw 1 dt 2 title "same edge angle", \
     curves."/sync_curves.dat" using 1:2 with lines lc rgb "#333333" lw 2 title "edge A(s)", \
     curves."/sync_curves.dat" using 1:3 with lines lc rgb "#c4451c" lw 2.5 title "stick radius c(s)", \
     curves."/sync_points.dat" using 1:2 with points pt 7 ps 0.5 lc rgb "#1f6f8b" title "points of collocation", \
     curves."/sync_points.dat" using 1:($3 > 0 ? $2 : NaN) with points pt 6 ps 1.1 lw 1.5 lc rgb "#1f6f8b" title "ends of panels"
