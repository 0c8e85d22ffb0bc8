# SPDX-License-Identifier: BSD-3-Clause
# Cooling of five gases, from the table that granular_gas writes:
#   gnuplot -e "courses='cooling.csv'; figure='cooling.svg'" cooling.gp
set terminal svg size 1000,460 font "Helvetica,14" background "white"
set output figure
set datafile separator ","
set grid lc rgb "#dddddd" lw 1
set border lw 1
set style line 1 lc rgb "#888888" lw 2.5
set style line 2 lc rgb "#1f6f8b" lw 2.5
set style line 3 lc rgb "#c4451c" lw 2.5
set style line 4 lc rgb "#5b8c2a" lw 2.5
set style line 5 lc rgb "#7a4fa3" lw 2.5
set style line 9 lc rgb "#000000" lw 1 dt 3
set logscale x
set format x "10^{%T}"
set xlabel "time, mean free paths over the first rms speed"
set multiplot layout 1,2
set logscale y
set format y "10^{%T}"
set ylabel "temperature T/T_0"
set key bottom left samplen 1.5
plot for [gas=0:4] courses index gas using 2:3 with lines ls gas+1 notitle, \
     for [gas=0:4] courses index gas using 2:5 with lines ls 9 notitle, \
     keyentry with lines ls 9 title "theory, Maxwell's velocities"
unset logscale y
set format y "%g"
set yrange [0:2.6]
set ylabel "p, where T falls as 1 over the p-th power of t"
set key bottom right
set xrange [10:*]
set ytics 0, 0.5
set ytics add ("5/3" 5.0/3)
plot for [gas=0:4] courses index gas using 2:6 with lines ls gas+1 title gas == 0 ? "constant e_z = 0.8" : \
         gas == 1 ? "Kelvin-Voigt, no friction" : gas == 2 ? "Kelvin-Voigt, friction 0.3" : \
         gas == 3 ? "standard solid, no friction" : "polyisobutylene, friction 0.3"
unset multiplot
