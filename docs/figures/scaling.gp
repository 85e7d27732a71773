# What a drone costs in a tick: gnuplot -e "data='out/bench/scaling.dat'" docs/figures/scaling.gp
set terminal svg size 960,340 dynamic font 'sans,12' background '#ffffff'
set output 'docs/figures/scaling.svg'
set multiplot layout 1,3
set grid lc rgb '#dddddd'
set border lc rgb '#666666'
set tics nomirror
set key top left samplen 2
set yrange [0:*]
set ylabel 'ns a drone'
set style line 1 lw 2 pt 7 ps 0.5 lc rgb '#1b5e9e'
set style line 2 lw 2 pt 7 ps 0.5 lc rgb '#c2571a'
set style line 3 lw 2 pt 7 ps 0.5 lc rgb '#3b7d3b'
set style line 4 lw 2 dt 2 pt 7 ps 0.5 lc rgb '#1b5e9e'
set xlabel 'drones'
set logscale x
set format x '10^{%T}'
plot data index 0 using 1:2 with linespoints ls 1 title 'tick, one thread', \
     data index 1 using 1:2 with linespoints ls 4 title 'tick, two threads', \
     data index 0 using 1:3 with linespoints ls 2 title 'safety filter', \
     data index 0 using 1:4 with linespoints ls 3 title 'ergodic step'
unset logscale x
set format x '%g'
set xlabel 'K, 10 000 drones'
plot data index 2 using 1:2 with linespoints ls 1 title 'tick', \
     data index 2 using 1:3 with linespoints ls 2 title 'safety filter', \
     data index 2 using 1:4 with linespoints ls 3 title 'ergodic step'
set xlabel 'neighbours in reach, 10 000 drones'
plot data index 3 using 1:2 with linespoints ls 1 title 'tick', \
     data index 3 using 1:3 with linespoints ls 2 title 'safety filter', \
     data index 3 using 1:4 with linespoints ls 3 title 'ergodic step'
