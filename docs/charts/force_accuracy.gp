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
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4. 0.05 to 2 radii deep. Shaded: what the default promises.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
2.824 4.6698
8.343 2.1748
22.123 0.97027
EOD
$blanch << EOD
9.565 4.7305
31.536 1.6495
74.982 0.57878
175.12 0.31865
625.46 0.20198
1887.3 0.087147
4482.2 0.042924
EOD
$energy << EOD
8.592 3.4886
28.692 1.1363
68.362 0.4132
190.16 0.3493
566.53 0.18549
1583 0.14777
3740.8 0.06358
EOD
$lod_blanch << EOD
5.588 0.4587
EOD
$lod << EOD
4.316 0.51836
EOD
$fine << EOD
31.197 0.14998
EOD
set title 'Smooth: plane, ball, torus' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 1 behind fc rgb '#e8f4e6' fs solid noborder
set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35 font ',11'
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
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
0.14 110.52
EOD
$stencil << EOD
2.824 22.476
8.343 13.373
22.123 7.196
EOD
$blanch << EOD
9.995 18.023
31.667 13.389
79.378 12.303
170.89 8.989
640.17 7.0602
1886.1 5.1428
4508 3.7231
EOD
$energy << EOD
8.733 5.3776
28.292 5.0877
67.611 1.0105
189.42 0.94693
557.3 0.64567
1586.9 0.20834
3735.5 0.20823
EOD
$lod_blanch << EOD
5.598 12.609
EOD
$lod << EOD
4.246 1.1504
EOD
$fine << EOD
31.197 0.80342
EOD
set title 'Edge of 90°' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
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
2.824 12
8.343 6.3083
22.123 5.0317
EOD
$blanch << EOD
9.985 10.572
31.998 8.8355
76.363 7.2089
179.27 6.5348
604.77 5.5803
1906.5 5.1828
4503.5 4.5995
EOD
$energy << EOD
8.532 3.2173
27.02 1.1673
71.266 1.0324
189.95 1.0117
574.28 1.0109
1588.8 0.31771
3747.8 0.30166
EOD
$lod_blanch << EOD
5.528 7.222
EOD
$lod << EOD
4.247 1.0377
EOD
$fine << EOD
31.197 2.2695
EOD
set title 'Rough plane' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
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
0.14 211.77
EOD
$stencil << EOD
2.824 24.679
8.343 16.317
22.123 12.26
EOD
$blanch << EOD
9.324 33.841
31.398 20.954
71.736 15.896
176.84 10.736
604.2 8.6235
1898 6.7927
4482.9 5.0305
EOD
$energy << EOD
8.722 6.1612
28.502 4.6832
71.296 1.5038
189.97 1.5075
553.44 1.3708
1586.8 0.39846
3745.9 0.40047
EOD
$lod_blanch << EOD
5.227 15.787
EOD
$lod << EOD
4.076 2.3674
EOD
$fine << EOD
31.197 3.3362
EOD
set title 'Slot one radius wide' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
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
0.14 124.88
EOD
$stencil << EOD
2.824 15.606
8.343 9.3483
22.123 4.6888
EOD
$blanch << EOD
9.554 10.128
31.096 4.9906
75.804 3.6063
178.07 2.7878
618.23 2.8969
1889.9 0.67816
4453.3 0.65858
EOD
$energy << EOD
8.733 5.5186
28.022 4.2181
67.431 3.2962
189.84 3.3177
553.93 3.3058
1587.3 1.2994
3751.7 1.3027
EOD
$lod_blanch << EOD
5.77 2.7008
EOD
$lod << EOD
4.336 3.2978
EOD
$fine << EOD
31.197 0.34882
EOD
set title 'Sheet one radius thick' font ',13' offset 0,-0.4
unset object 1
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
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
0.14 175.2
EOD
$stencil << EOD
2.824 30.135
8.343 16.398
22.123 10.341
EOD
$blanch << EOD
9.235 28.455
31.196 20.006
73.389 14.951
171.22 9.4801
610 8.3184
1883.5 7.2753
4430.9 4.5242
EOD
$energy << EOD
8.403 10.203
26.179 4.9261
61.042 2.4956
190.11 2.3187
518.45 1.3795
1581.2 1.5752
3734.5 1.5752
EOD
$lod_blanch << EOD
5.277 13.678
EOD
$lod << EOD
4.057 2.2897
EOD
$fine << EOD
31.197 0.88172
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel'
unset label 1
unset label 2
unset multiplot
