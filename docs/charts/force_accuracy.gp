# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,720 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_accuracy.svg'
set logscale xy
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: accuracy against time (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4; 0.05 to 2 radii deep. Shaded: what the default promises.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set xrange [0.08:2e4]
set yrange [1e-3:1e3]
set multiplot
set lmargin at screen 0.075
set rmargin at screen 0.28
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y '%g'
set ylabel 'error of the force, p95 [%]'
unset xlabel
$point << EOD
0.14 100
EOD
$stencil << EOD
2.834 4.9405
8.352 2.3994
22.103 1.0169
EOD
$blanch << EOD
8.943 5.9728
29.754 1.8895
71.155 0.86928
247.04 0.41072
579.47 0.20198
1759.2 0.051045
4071.8 0.036067
EOD
$energy << EOD
6.97 3.3259
22.924 1.3557
52.939 0.41833
187.71 0.45619
435.04 0.18495
1425.5 0.057816
3347.5 0.057814
EOD
$lod_blanch << EOD
4.167 0.63556
EOD
$lod << EOD
3.474 0.54101
EOD
$fine << EOD
464.63 0.082028
EOD
set title 'Smooth: plane, ball, torus' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 1 behind fc rgb '#e8f4e6' fs solid noborder
set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35 font ',11'
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
set lmargin at screen 0.315
set rmargin at screen 0.52
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y ''
unset ylabel
unset xlabel
$point << EOD
0.14 100.17
EOD
$stencil << EOD
2.834 26.931
8.352 15.309
22.103 7.3591
EOD
$blanch << EOD
8.993 18.447
29.865 13.882
71.346 13.071
246.36 9.4765
580.59 7.199
1617.1 5.9433
3980.5 4.3979
EOD
$energy << EOD
7.02 6.8277
22.463 5.3888
52.958 1.0816
186.78 1.0634
435.6 0.54599
1423 0.30749
3359.6 0.30733
EOD
$lod_blanch << EOD
4.166 13.593
EOD
$lod << EOD
3.456 1.1548
EOD
$fine << EOD
464.63 0.87343
EOD
set title 'Edge of 90°' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
set lmargin at screen 0.555
set rmargin at screen 0.76
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y ''
unset ylabel
unset xlabel
$point << EOD
0.14 100
EOD
$stencil << EOD
2.834 12.149
8.352 7.2104
22.103 4.7189
EOD
$blanch << EOD
9.014 10.327
30.074 8.5669
71.126 7.1735
247.45 6.452
573.3 5.6194
1718 5.788
4058.9 4.5995
EOD
$energy << EOD
7.01 3.2285
23.365 0.77914
52.919 0.73058
187.3 0.73273
433.86 0.70554
1408.4 0.24629
3333 0.30756
EOD
$lod_blanch << EOD
4.147 7.2344
EOD
$lod << EOD
3.455 0.7607
EOD
$fine << EOD
464.63 0.46677
EOD
set title 'Rough plane' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
set lmargin at screen 0.075
set rmargin at screen 0.28
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y '%g'
set ylabel 'error of the force, p95 [%]'
set xlabel 'median time of a query [µs]'
$point << EOD
0.14 288.1
EOD
$stencil << EOD
2.834 24.463
8.352 16.349
22.103 11.845
EOD
$blanch << EOD
8.723 38.353
29.684 21.234
70.946 16.163
245.46 10.896
575.28 8.6174
1695 6.8297
4080.8 5.0542
EOD
$energy << EOD
6.95 6.516
22.954 5.0983
52.958 1.7915
187 1.9715
434.83 1.7265
1412.8 0.22249
3346.3 0.22235
EOD
$lod_blanch << EOD
4.166 16.27
EOD
$lod << EOD
3.465 2.3439
EOD
$fine << EOD
464.63 2.1921
EOD
set title 'Slot one radius wide' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
set lmargin at screen 0.315
set rmargin at screen 0.52
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y ''
unset ylabel
set xlabel 'median time of a query [µs]'
$point << EOD
0.14 100.79
EOD
$stencil << EOD
2.834 13.994
8.352 9.2583
22.103 3.7107
EOD
$blanch << EOD
9.003 10.14
29.794 4.7875
71.306 2.4042
247.66 1.4906
581.24 1.4504
1739.6 0.45199
4437.5 0.44997
EOD
$energy << EOD
6.981 5.8925
23.325 3.7308
52.999 3.7031
188.64 3.6935
435.56 3.6844
1416.8 1.0278
3350.1 1.0327
EOD
$lod_blanch << EOD
4.187 2.3875
EOD
$lod << EOD
3.475 3.6867
EOD
$fine << EOD
464.63 0.32792
EOD
set title 'Sheet one radius thick' font ',13' offset 0,-0.4
unset object 1
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
set lmargin at screen 0.555
set rmargin at screen 0.76
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y ''
unset ylabel
set xlabel 'median time of a query [µs]'
$point << EOD
0.14 464.08
EOD
$stencil << EOD
2.834 36.089
8.352 17.833
22.103 10.852
EOD
$blanch << EOD
9.004 31.304
29.834 20.147
71.226 17.135
245.87 11.518
575.36 8.8515
1756.4 3.6016
4422.6 2.3377
EOD
$energy << EOD
6.981 10.933
22.825 5.3128
52.849 2.5074
187.81 2.3732
433.51 1.3504
1421 0.99742
3358.4 0.99755
EOD
$lod_blanch << EOD
4.167 17.016
EOD
$lod << EOD
3.475 2.2495
EOD
$fine << EOD
464.63 0.65819
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
unset multiplot
