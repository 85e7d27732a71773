# Draws docs/figures/vehicle_models.svg: each recorded velocity step and its model.
#   cmake --build build/dev --target vehicle_overlay
#   build/dev/vigil/core/dynamics/vehicle_overlay > overlay.txt
#   gnuplot -e "data='overlay.txt'" docs/figures/vehicle_models.gp
set terminal svg size 1100,1250 font "sans-serif,11" background rgb "white"
set output "docs/figures/vehicle_models.svg"
stats data nooutput
set multiplot layout 5,4 rowsfirst downwards margins 0.045,0.985,0.045,0.955 spacing 0.045,0.055
set grid lc rgb "#dddddd"
set border 3 lc rgb "#888888"
set tics nomirror out scale 0.4 font ",9"
set title offset 0,-0.7
set autoscale noextend
set offsets 0,0,graph 0.04,graph 0.04
set label 1 "velocity in m/s over time in s: grey recorded, blue line model, dashed commanded" at screen 0.045,0.988 font ",13"
do for [i=0:STATS_blocks-1] {
  name = system(sprintf("grep '^#' %s | sed -n %dp | cut -c 3-", data, i + 1))
  set title name noenhanced
  plot data index i every 2 using 1:2 with steps dt 2 lc rgb "#888888" notitle, \
       data index i every 3 using 1:3 with lines lw 4 lc rgb "#c0c0c0" notitle, \
       data index i every 2 using 1:4 with lines lw 1.4 lc rgb "#0060c0" notitle
  unset label 1
}
unset multiplot
