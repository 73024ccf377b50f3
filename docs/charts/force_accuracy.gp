# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,720 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_accuracy.svg'
set logscale xy
set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' 1e4, '10⁵' 1e5)
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: accuracy against time (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4; 0.05 to 2 radii deep. Shaded: promised; of the sheet 1 % of what both faces push.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set xrange [0.08:1e5]
set yrange [1e-3:1e3]
set multiplot
set lmargin at screen 0.075
set rmargin at screen 0.275
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y '%g'
set ylabel 'error of the force, p95 [%]'
unset xlabel
$point << EOD
0.18 100
EOD
$stencil << EOD
3.757 4.9405
12.593 2.3994
40.015 1.0169
EOD
$blanch << EOD
11.863 5.6058
40.336 1.8751
106.53 0.86066
343.62 0.40604
786.53 0.21785
2397.5 0.32318
5499.2 0.045548
EOD
$energy << EOD
9.849 3.2633
32.772 1.0513
79.2 0.21965
274.43 0.20164
646.76 0.12665
1866.1 0.36667
4424.2 0.033366
EOD
$lod_blanch << EOD
11.231 0.62129
EOD
$lod << EOD
9.047 0.41637
EOD
$servo << EOD
8.756 0.4202
EOD
$fine << EOD
548.41 0.082028
EOD
$windows << EOD
2875.5 0.4202
27978 0.4202
18416 0.4202
EOD
$centre << EOD
0.571 0.50222
9.047 0.21257
EOD
set title 'Smooth: plane, ball, torus' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 1 behind fc rgb '#e8f4e6' fs solid noborder
set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35 font ',11'
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new', $centre with linespoints pt 8 ps 1.1 lw 1.5 lc rgb '#7b3294' title 'centre where enough, lod there'
unset label 1
unset label 2
set lmargin at screen 0.31
set rmargin at screen 0.51
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y ''
unset ylabel
unset xlabel
$point << EOD
0.181 103.03
EOD
$stencil << EOD
3.757 26.931
12.593 15.309
40.015 7.3591
EOD
$blanch << EOD
12.513 18.485
42.77 13.495
107.88 13.074
346.18 9.1326
839.33 7.1754
2429.2 5.8062
5766.3 4.3444
EOD
$energy << EOD
10.27 6.5249
33.964 5.1117
81.022 0.98077
274.77 0.9106
661.6 0.53986
2066.3 0.55588
4475.5 0.55604
EOD
$lod_blanch << EOD
11.482 13.587
EOD
$lod << EOD
9.398 1.1416
EOD
$servo << EOD
9.569 1.1416
EOD
$fine << EOD
548.41 0.87343
EOD
$windows << EOD
876.38 1.1416
23136 1.1416
27494 1.1416
EOD
set title 'Edge of 90°' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
set lmargin at screen 0.545
set rmargin at screen 0.745
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y ''
unset ylabel
unset xlabel
$point << EOD
0.21 100
EOD
$stencil << EOD
3.757 12.149
12.593 7.2104
40.015 4.7189
EOD
$blanch << EOD
12.633 10.333
43.281 8.3324
110.82 7.1582
360.2 6.1289
852.01 5.4345
2466.7 5.7199
5932.3 4.6503
EOD
$energy << EOD
10.579 2.8717
34.174 0.77313
81.664 0.49624
285.65 0.43
668.7 0.4644
2092 0.29761
4851 0.22871
EOD
$lod_blanch << EOD
11.653 7.1784
EOD
$lod << EOD
9.607 0.51098
EOD
$servo << EOD
9.688 0.51098
EOD
$fine << EOD
548.41 0.46677
EOD
$windows << EOD
2434.7 0.51098
11608 0.51098
24502 0.51098
EOD
set title 'Rough plane' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
set lmargin at screen 0.075
set rmargin at screen 0.275
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y '%g'
set ylabel 'error of the force, p95 [%]'
set xlabel 'median time from hand to force [µs]'
$point << EOD
0.23 269.21
EOD
$stencil << EOD
3.757 24.463
12.593 16.349
40.015 11.845
EOD
$blanch << EOD
12.424 39.879
41.718 20.573
104.56 16.174
343.98 10.591
826.56 8.3479
2423.4 6.6509
5439.7 5.0325
EOD
$energy << EOD
10.049 6.5656
33.333 4.954
78.426 1.4243
271.79 1.2164
645.07 0.89274
2020.5 0.24425
4796.6 0.20707
EOD
$lod_blanch << EOD
11.172 16.336
EOD
$lod << EOD
9.317 2.1882
EOD
$servo << EOD
9.379 2.1882
EOD
$fine << EOD
548.41 2.1921
EOD
$windows << EOD
2070.2 2.1882
19099 2.1882
34815 2.1882
EOD
set title 'Slot one radius wide' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
set lmargin at screen 0.31
set rmargin at screen 0.51
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y ''
unset ylabel
set xlabel 'median time from hand to force [µs]'
$point << EOD
0.251 100.79
EOD
$stencil << EOD
3.757 13.994
12.593 9.2583
40.015 3.7107
EOD
$blanch << EOD
12.934 12.976
43.171 5.8045
109.33 4.4403
358.28 1.7619
853.89 1.7244
2417.7 0.68894
5680.5 0.68809
EOD
$energy << EOD
10.821 4.284
35.567 3.2683
85.851 3.2851
296.76 3.2117
693.02 3.2161
2130 0.86167
5140.6 0.85557
EOD
$lod_blanch << EOD
12.274 4.5119
EOD
$lod << EOD
9.958 3.275
EOD
$servo << EOD
10.059 3.275
EOD
$fine << EOD
548.41 0.32792
EOD
$windows << EOD
1948 3.275
17612 3.275
19329 3.275
EOD
$centre << EOD
0.57 0.99262
9.958 0.21891
EOD
set title 'Sheet one radius thick' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 2.1857 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new', $centre with linespoints pt 8 ps 1.1 lw 1.5 lc rgb '#7b3294' title 'centre where enough, lod there'
unset label 1
unset label 2
set lmargin at screen 0.545
set rmargin at screen 0.745
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y ''
unset ylabel
set xlabel 'median time from hand to force [µs]'
$point << EOD
0.181 464.08
EOD
$stencil << EOD
3.757 36.082
12.593 17.833
40.015 10.852
EOD
$blanch << EOD
11.732 31.5
39.624 19.836
103.74 17.854
332.09 11.016
753.89 8.7743
2409.9 3.3946
5636.2 2.314
EOD
$energy << EOD
10.109 10.276
32.632 4.568
78.356 2.047
271.91 1.7426
640.93 1.3699
1960.9 0.87266
4640.2 0.87201
EOD
$lod_blanch << EOD
11 17.223
EOD
$lod << EOD
8.776 1.9979
EOD
$servo << EOD
8.926 1.9979
EOD
$fine << EOD
548.41 0.6582
EOD
$windows << EOD
850.03 1.9979
11553 1.9979
15374 1.9979
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
unset multiplot
