# SPDX-License-Identifier: BSD-3-Clause
# The figures of docs/records/measurements.md from the curves of `measurements` and the points of
# tests/data:
#   gnuplot -e "curves='DIR'; data='DIR'; figures='DIR'" measurements.gp
set terminal svg size 640,420 font "Helvetica,14" background "white"
set datafile separator ","
set grid lc rgb "#dddddd" lw 1
set border lw 1
set style line 1 lc rgb "#1f6f8b" lw 2.5
set style line 2 lc rgb "#c4451c" pt 7 ps 0.7
set style line 3 lc rgb "#888888" lw 1.5 dt 2

set output figures."/kharaz.svg"
set xlabel "angle from the normal, degrees"
set ylabel "tangential restitution of the centre, e_t"
set xrange [0:90]
set yrange [0.5:1]
set xtics 15
set key bottom right
psi_c = 28.2  # tan(angle) = 0.092 (4 chi - 1)/0.859
set arrow 1 from psi_c, graph 0 to psi_c, graph 1 nohead ls 3
set label 1 "stick occurs" at psi_c-1.5, 0.96 right textcolor rgb "#555555"
set label 2 "slip to the end" at psi_c+1.5, 0.96 left textcolor rgb "#555555"
plot curves."/kharaz.csv" using 1:2 with lines ls 1 title "restitute", \
     data."/kharaz_oblique.csv" every ::1 using 1:2 with points ls 2 title "measured (Kharaz et al.)"

set output figures."/fem.svg"
set xlabel "V_t/({/Symbol m} V_n)"
set ylabel "-R w'/({/Symbol m} V_n)"
set xrange [0:19]
set yrange [0:6]
set xtics 2
psi_c = 5.79  # (4 chi - 1)/0.824
set arrow 1 from psi_c, graph 0 to psi_c, graph 1 nohead ls 3
set label 1 "stick occurs" at psi_c-0.3, 5.6 right
set label 2 "slip to the end" at psi_c+0.3, 5.6 left
plot curves."/fem.csv" using 1:(-$2) with lines ls 1 title "restitute", \
     data."/fem_oblique.csv" every ::1 using 1:(-$2) with points ls 2 title "finite elements (Chung and Ooi)"
