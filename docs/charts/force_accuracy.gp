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
2.824 4.9405
8.352 2.3994
22.123 1.0169
EOD
$blanch << EOD
8.833 5.9728
29.624 1.8895
70.865 0.86928
245.23 0.41072
576.92 0.20198
1740.8 0.051045
4049.5 0.036067
EOD
$energy << EOD
6.971 3.3259
22.944 1.3557
53.049 0.41833
187.96 0.45619
435.49 0.18495
1429.2 0.057816
3349.9 0.057814
EOD
$lod_blanch << EOD
4.157 0.63556
EOD
$lod << EOD
3.465 0.54101
EOD
$fine << EOD
459.46 0.082028
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
2.824 26.931
8.352 15.309
22.123 7.3591
EOD
$blanch << EOD
8.943 18.447
29.655 13.882
70.987 13.071
244.14 9.4765
578.92 7.199
1621.2 5.9433
3948.8 4.3979
EOD
$energy << EOD
7.02 6.8277
22.553 5.3888
53.119 1.0816
186.22 1.0634
437.55 0.54599
1422.3 0.30749
3383.4 0.30733
EOD
$lod_blanch << EOD
4.166 13.593
EOD
$lod << EOD
3.465 1.1548
EOD
$fine << EOD
459.46 0.87343
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
2.824 12.149
8.352 7.2104
22.123 4.7189
EOD
$blanch << EOD
8.983 10.327
29.944 8.5669
70.886 7.1735
245.22 6.452
575.78 5.6194
1730.4 5.788
4253 4.5995
EOD
$energy << EOD
7 3.2285
23.365 0.77914
53.05 0.73058
188.03 0.73273
435.12 0.70554
1425.4 0.24629
3351.9 0.30756
EOD
$lod_blanch << EOD
4.136 7.2344
EOD
$lod << EOD
3.445 0.7607
EOD
$fine << EOD
459.46 0.46677
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
2.824 24.463
8.352 16.349
22.123 11.845
EOD
$blanch << EOD
8.663 38.353
29.544 21.234
70.695 16.163
245.05 10.896
578.2 8.6174
1693.8 6.8297
4038 5.0542
EOD
$energy << EOD
6.96 6.516
22.954 5.0983
53.099 1.7915
187.83 1.9715
435.46 1.7265
1423.1 0.22249
3381.8 0.22235
EOD
$lod_blanch << EOD
4.176 16.27
EOD
$lod << EOD
3.466 2.3439
EOD
$fine << EOD
459.46 2.1921
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
2.824 13.994
8.352 9.2583
22.123 3.7107
EOD
$blanch << EOD
8.763 10.14
29.655 4.7875
70.865 2.4042
244.81 1.4906
577.06 1.4504
1716.3 0.45199
3999.4 0.44997
EOD
$energy << EOD
6.98 5.8925
22.994 3.7308
53.099 3.7031
188.5 3.6935
437.6 3.6844
1429.1 1.0278
3345.5 1.0327
EOD
$lod_blanch << EOD
4.207 2.3875
EOD
$lod << EOD
3.475 3.6867
EOD
$fine << EOD
459.46 0.32792
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
2.824 36.089
8.352 17.833
22.123 10.852
EOD
$blanch << EOD
8.994 31.304
29.765 20.147
70.915 17.135
246.13 11.518
578.8 8.8515
1867.6 3.6016
4073.7 2.3377
EOD
$energy << EOD
7 10.933
22.884 5.3128
53.02 2.5074
188.22 2.3732
434.42 1.3504
1410 0.99742
3370.8 0.99755
EOD
$lod_blanch << EOD
4.146 17.016
EOD
$lod << EOD
3.466 2.2495
EOD
$fine << EOD
459.46 0.65819
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32'
unset label 1
unset label 2
unset multiplot
