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
set label 2 'From the whole surface to 50, 30, 10, 3 and 1 % of its triangles, a mark each. Further down is more exact. Mean distance between mesh and clay in finest voxels, the worse of both ways; CPU time of all threads.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
20388 0.00577211
12232 0.00869951
4078 0.0208529
1224 0.0521912
408 0.123076
EOD
$d1 << EOD
20388 0.00814935
12232 0.0133948
4078 0.0438459
1224 0.12338
408 0.332983
EOD
$d2 << EOD
20388 0.00746263
12232 0.0114735
4078 0.0277111
1224 0.074177
408 0.171482
EOD
$d3 << EOD
408 0.00602736
20388 0.00602736
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
23844 0.00428335
14306 0.00497425
4768 0.00850141
1430 0.0134615
476 0.0336938
EOD
$d1 << EOD
23844 0.0328934
14306 0.0421733
4768 0.0439467
1430 0.0535359
476 0.108544
EOD
$d2 << EOD
23844 0.0329702
14306 0.0329807
4768 0.0345625
1430 0.0437141
476 0.061469
EOD
$d3 << EOD
476 0.0326354
23844 0.0326354
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
0.214798 0.00577211
0.193306 0.00869951
0.192801 0.0208529
0.229319 0.0521912
0.231487 0.123076
EOD
$d1 << EOD
0.396236 0.00814935
0.565894 0.0133948
0.837393 0.0438459
0.7131 0.12338
0.783531 0.332983
EOD
$d2 << EOD
0.205998 0.00746263
0.285162 0.0114735
0.365129 0.0277111
0.382494 0.074177
0.524727 0.171482
EOD
$d3 << EOD
0.192801 0.00602736
0.837393 0.00602736
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
set lmargin at screen 0.56
set rmargin at screen 0.985
set tmargin at screen 0.44
set bmargin at screen 0.15
set title 'block: for the same time' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
0.42148 0.00428335
0.659291 0.00497425
0.879397 0.00850141
0.943007 0.0134615
1.15115 0.0336938
EOD
$d1 << EOD
1.16958 0.0328934
1.66584 0.0421733
1.49772 0.0439467
1.83652 0.0535359
1.88737 0.108544
EOD
$d2 << EOD
1.40797 0.0329702
1.50541 0.0329807
1.44846 0.0345625
1.44356 0.0437141
1.33657 0.061469
EOD
$d3 << EOD
0.42148 0.0326354
1.88737 0.0326354
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
