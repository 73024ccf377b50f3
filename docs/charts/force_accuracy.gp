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
0.381 100
EOD
$stencil << EOD
3.737 4.9405
13.025 2.3994
40.446 1.0169
EOD
$blanch << EOD
15.02 5.6058
50.995 1.8739
128.13 0.86066
426.58 0.40604
996.78 0.16898
2975.7 0.097646
7213.7 0.045548
EOD
$energy << EOD
10.179 3.2633
33.844 1.0513
80.812 0.21964
278.54 0.20178
651.76 0.08091
1843.2 0.048213
4486.1 0.033363
EOD
$lod_blanch << EOD
11.743 0.61194
EOD
$lod << EOD
9.538 0.40374
EOD
$servo << EOD
8.887 0.41637
EOD
$fine << EOD
559.77 0.082028
EOD
$windows << EOD
2502.7 0.41637
20526 0.41637
21107 0.41637
EOD
$centre << EOD
0.781 0.50219
9.538 0.21256
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
0.38 103.03
EOD
$stencil << EOD
3.737 26.931
13.025 15.309
40.446 7.3591
EOD
$blanch << EOD
15.309 18.485
51.706 13.348
130.97 13.074
429.36 9.1199
1018.5 7.1754
2549.2 5.8041
6397.3 4.3445
EOD
$energy << EOD
10.119 6.8723
34.415 5.4574
83.847 1.1866
286.91 1.128
683.36 0.61915
1944.2 0.28126
4747.5 0.29754
EOD
$lod_blanch << EOD
11.861 13.587
EOD
$lod << EOD
9.748 1.2497
EOD
$servo << EOD
9.838 1.2497
EOD
$fine << EOD
559.77 0.87343
EOD
$windows << EOD
1465.3 1.2497
24058 1.2497
24470 1.2497
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
0.431 100
EOD
$stencil << EOD
3.737 12.149
13.025 7.2104
40.446 4.7189
EOD
$blanch << EOD
15.699 10.333
53.482 8.3326
133.01 7.1582
436.5 6.1295
1028.6 5.4335
3142.9 5.7244
7464.6 4.6503
EOD
$energy << EOD
10.49 2.8717
35.807 0.78332
83.348 0.47812
292.49 0.50795
674.71 0.4792
2162.9 0.29763
5083.5 0.22871
EOD
$lod_blanch << EOD
12.073 7.1784
EOD
$lod << EOD
10.009 0.55214
EOD
$servo << EOD
10.129 0.55214
EOD
$fine << EOD
559.77 0.46677
EOD
$windows << EOD
1753.5 0.55214
9645.6 0.55214
21210 0.55214
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
0.371 269.21
EOD
$stencil << EOD
3.737 24.463
13.025 16.349
40.446 11.845
EOD
$blanch << EOD
14.977 39.879
50.505 20.46
124.96 16.125
417.18 10.532
971.95 8.3479
2765.4 6.6361
6905.6 5.0325
EOD
$energy << EOD
9.848 6.5656
32.961 5.1997
79.31 1.2306
272.26 1.1176
641.32 0.82098
1998.6 0.31999
4403.9 0.28045
EOD
$lod_blanch << EOD
11.762 16.314
EOD
$lod << EOD
9.488 1.8447
EOD
$servo << EOD
9.528 1.8447
EOD
$fine << EOD
559.77 2.1921
EOD
$windows << EOD
1428.9 1.8447
12496 1.8447
25809 1.8447
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
0.42 100.79
EOD
$stencil << EOD
3.737 13.994
13.025 9.2583
40.446 3.7107
EOD
$blanch << EOD
15.148 12.973
50.435 4.6752
125 2.8171
412.88 1.1965
972.65 0.73315
3053.4 0.22412
7350.4 0.22541
EOD
$energy << EOD
10.59 4.3483
34.905 0.84716
81.711 0.57836
285.01 0.61915
664.3 0.60425
2148.4 0.24441
5058.2 0.24595
EOD
$lod_blanch << EOD
12.402 2.8159
EOD
$lod << EOD
9.95 0.66896
EOD
$servo << EOD
10.198 0.69523
EOD
$fine << EOD
559.77 0.32792
EOD
$windows << EOD
1350.5 0.69523
19266 0.69523
23412 0.69523
EOD
$centre << EOD
0.752 0.7779
9.95 0.10368
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
0.37 464.08
EOD
$stencil << EOD
3.737 36.082
13.025 17.833
40.446 10.852
EOD
$blanch << EOD
14.988 31.639
50.895 19.723
127.2 17.854
423.69 11.049
986.2 8.7743
2741 3.4007
6704.9 2.314
EOD
$energy << EOD
9.689 10.276
32.099 4.5949
76.123 2.047
263.54 1.7741
623.02 1.3944
1880.4 0.87066
4540.1 0.8704
EOD
$lod_blanch << EOD
11.051 17.223
EOD
$lod << EOD
8.977 1.9979
EOD
$servo << EOD
9.166 1.9979
EOD
$fine << EOD
559.77 0.6582
EOD
$windows << EOD
716.55 1.9979
10296 1.9979
10891 1.9979
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 3 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $fine with points pt 11 ps 1.1 lc rgb '#000000' title 'fine: every finest voxel, R ≤ 32', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
unset multiplot
