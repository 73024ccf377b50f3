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
20388 0.00573044
12232 0.00869184
4078 0.020136
1224 0.0517382
408 0.13092
EOD
$d1 << EOD
20388 0.00910421
12232 0.0134013
4078 0.0430142
1224 0.123015
408 0.361151
EOD
$d2 << EOD
20388 0.00890109
12232 0.0113607
4078 0.0256625
1224 0.0691463
408 0.174052
EOD
$d3 << EOD
408 0.00850548
20388 0.00850548
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
23972 0.00360826
14384 0.00344531
4794 0.00540751
1438 0.0168928
480 0.0360773
EOD
$d1 << EOD
23972 0.0204807
14384 0.0203228
4794 0.0245146
1438 0.0428103
480 0.0863357
EOD
$d2 << EOD
23972 0.0208893
14384 0.0209088
4794 0.0241113
1438 0.0337571
480 0.0548679
EOD
$d3 << EOD
480 0.0209294
23972 0.0209294
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
0.0681675 0.00573044
0.0540826 0.00869184
0.0436654 0.020136
0.0423455 0.0517382
0.0399491 0.13092
EOD
$d1 << EOD
0.368577 0.00910421
0.468584 0.0134013
0.5677 0.0430142
0.607055 0.123015
0.620716 0.361151
EOD
$d2 << EOD
0.120749 0.00890109
0.157093 0.0113607
0.205292 0.0256625
0.216911 0.0691463
0.216574 0.174052
EOD
$d3 << EOD
0.0399491 0.00850548
0.620716 0.00850548
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#606060' notitle
set lmargin at screen 0.56
set rmargin at screen 0.985
set tmargin at screen 0.44
set bmargin at screen 0.15
set title 'block: for the same time' font ',13' offset 0,-0.5
set ylabel 'mean error [voxels]'
$d0 << EOD
0.0940878 0.00360826
0.0872256 0.00344531
0.0837241 0.00540751
0.0541634 0.0168928
0.045744 0.0360773
EOD
$d1 << EOD
0.979914 0.0204807
1.36751 0.0203228
1.52706 0.0245146
1.57034 0.0428103
1.61747 0.0863357
EOD
$d2 << EOD
0.644178 0.0208893
0.708708 0.0209088
0.754234 0.0241113
0.77036 0.0337571
0.765705 0.0548679
EOD
$d3 << EOD
0.045744 0.0209294
1.61747 0.0209294
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
