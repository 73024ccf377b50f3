# Made by 'argil chart decimate'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'decimate.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Fewer triangles: what they miss, and what they cost' at screen 0.03,0.965 font ',16'
set label 2 'From the whole surface to 50, 30, 10, 3 and 1 % of its triangles, a mark each. Further down is more exact. Mean distance between mesh and clay in finest voxels, the worse of both directions; CPU time of all threads.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set format y '%g'
set yrange [*:*]
set xlabel 'triangles'
set format x '%.0s%c'
set lmargin at screen 0.07
set rmargin at screen 0.495
set tmargin at screen 0.865
set bmargin at screen 0.575
set title 'wavy ball: at the same count' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
20388 0.00562093
12232 0.00843716
4078 0.020355
1224 0.0520281
408 0.123076
EOD
$d1 << EOD
20388 0.00816263
12232 0.0133533
4078 0.0438459
1224 0.12338
408 0.332983
EOD
$d2 << EOD
20388 0.00752621
12232 0.0111173
4078 0.0272734
1224 0.074177
408 0.171482
EOD
$d3 << EOD
408 0.00603539
20388 0.00603539
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
unset label 1
unset label 2
set lmargin at screen 0.56
set rmargin at screen 0.985
set tmargin at screen 0.865
set bmargin at screen 0.575
set title 'block: at the same count' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
23844 0.00570993
14306 0.00619093
4768 0.00967053
1430 0.0146753
476 0.0388666
EOD
$d1 << EOD
23844 0.041185
14306 0.0421733
4768 0.0449981
1430 0.0597207
476 0.108544
EOD
$d2 << EOD
23844 0.041285
14306 0.0412915
4768 0.0426576
1430 0.0516845
476 0.0684975
EOD
$d3 << EOD
476 0.0412859
23844 0.0412859
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
set xlabel 'CPU time [s]'
set format x '%g'
set lmargin at screen 0.07
set rmargin at screen 0.495
set tmargin at screen 0.44
set bmargin at screen 0.15
set title 'wavy ball: for the same time' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
0.208632 0.00562093
0.163318 0.00843716
0.155339 0.020355
0.166711 0.0520281
0.187112 0.123076
EOD
$d1 << EOD
0.333486 0.00816263
0.408837 0.0133533
0.55011 0.0438459
0.590013 0.12338
0.668426 0.332983
EOD
$d2 << EOD
0.175024 0.00752621
0.226144 0.0111173
0.189423 0.0272734
0.240802 0.074177
0.231819 0.171482
EOD
$d3 << EOD
0.155339 0.00603539
0.668426 0.00603539
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
set lmargin at screen 0.56
set rmargin at screen 0.985
set tmargin at screen 0.44
set bmargin at screen 0.15
set title 'block: for the same time' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
0.389548 0.00570993
0.443255 0.00619093
0.581623 0.00967053
0.682401 0.0146753
0.743353 0.0388666
EOD
$d1 << EOD
0.606959 0.041185
0.888646 0.0421733
0.970153 0.0449981
1.11512 0.0597207
1.03907 0.108544
EOD
$d2 << EOD
0.940468 0.041285
1.08325 0.0412915
1.11616 0.0426576
1.12599 0.0516845
1.1673 0.0684975
EOD
$d3 << EOD
0.389548 0.0412859
1.1673 0.0412859
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
unset label 1
unset label 2
unset logscale
unset border
unset tics
unset xlabel
unset ylabel
unset title
set lmargin at screen 0.03
set rmargin at screen 0.98
set tmargin at screen 0.085
set bmargin at screen 0
set key center top horizontal maxcols 4 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'Argil, against the clay', NaN with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' title 'OpenMesh, quadrics', NaN with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' title 'CGAL, Garland-Heckbert quadrics', NaN with lines lw 1.5 dt 2 lc rgb '#606060' title 'the whole surface'
unset multiplot
