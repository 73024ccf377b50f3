# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,720 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_ripple.svg'
set logscale xy
set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' 1e4, '10⁵' 1e5)
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: ripple against time (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4; half a radius deep, sliding three cells of the method’s own lattice.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set xrange [0.08:1e5]
set yrange [1e-3:1e3]
set multiplot
set lmargin at screen 0.075
set rmargin at screen 0.275
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y '%g'
set ylabel 'ripple while sliding, rms, p95 [%]'
unset xlabel
$point << EOD
0.18 0.4025
EOD
$stencil << EOD
3.757 0.085718
12.593 0.061667
40.015 0.032504
EOD
$blanch << EOD
11.863 3.0304
40.336 0.43837
106.53 0.19041
343.62 0.096457
786.53 0.036649
EOD
$energy << EOD
9.849 1.1759
32.772 0.22803
79.2 0.069995
274.43 0.023869
646.76 0.017062
EOD
$lod_blanch << EOD
11.231 0.14364
EOD
$lod << EOD
9.047 0.065713
EOD
$servo << EOD
8.756 0.065713
EOD
$windows << EOD
2875.5 0.065713
27978 0.065713
18416 0.065713
EOD
set title 'Smooth: plane, ball, torus' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35 font ',11'
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
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
0.181 17.966
EOD
$stencil << EOD
3.757 3.0822
12.593 3.1141
40.015 4.6922
EOD
$blanch << EOD
12.513 11.254
42.77 6.0713
107.88 3.6534
346.18 1.7383
839.33 0.99046
EOD
$energy << EOD
10.27 2.5546
33.964 0.71124
81.022 0.40712
274.77 0.34573
661.6 0.28242
EOD
$lod_blanch << EOD
11.482 2.8035
EOD
$lod << EOD
9.398 0.37074
EOD
$servo << EOD
9.569 0.37074
EOD
$windows << EOD
876.38 0.37074
23136 0.37074
27494 0.37074
EOD
set title 'Edge of 90°' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
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
0.21 33.235
EOD
$stencil << EOD
3.757 4.4743
12.593 3.0332
40.015 3.3088
EOD
$blanch << EOD
12.633 2.3098
43.281 1.1243
110.82 0.60098
360.2 0.30453
852.01 0.21052
EOD
$energy << EOD
10.579 1.287
34.174 0.47628
81.664 0.39383
285.65 0.27719
668.7 0.21711
EOD
$lod_blanch << EOD
11.653 0.46671
EOD
$lod << EOD
9.607 0.34202
EOD
$servo << EOD
9.688 0.34202
EOD
$windows << EOD
2434.7 0.34202
11608 0.34202
24502 0.34202
EOD
set title 'Rough plane' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
set lmargin at screen 0.075
set rmargin at screen 0.275
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y '%g'
set ylabel 'ripple while sliding, rms, p95 [%]'
set xlabel 'median time from hand to force [µs]'
$point << EOD
0.23 62.893
EOD
$stencil << EOD
3.757 7.9853
12.593 4.7025
40.015 5.0491
EOD
$blanch << EOD
12.424 17.771
41.718 10.748
104.56 7.7985
343.98 4.1877
826.56 2.5514
EOD
$energy << EOD
10.049 10.205
33.333 1.8883
78.426 1.7155
271.79 1.5642
645.07 1.0038
EOD
$lod_blanch << EOD
11.172 8.1502
EOD
$lod << EOD
9.317 1.4746
EOD
$servo << EOD
9.379 1.4746
EOD
$windows << EOD
2070.2 1.4746
19099 1.4746
34815 1.4746
EOD
set title 'Slot one radius wide' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
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
0.251 9.3921
EOD
$stencil << EOD
3.757 0.95962
12.593 1.6751
40.015 0.73847
EOD
$blanch << EOD
12.934 3.8869
43.171 1.3969
109.33 1.1295
358.28 0.73806
853.89 0.58629
EOD
$energy << EOD
10.821 1.9126
35.567 1.6461
85.851 1.2728
296.76 0.75484
693.02 0.58756
EOD
$lod_blanch << EOD
12.274 0.8988
EOD
$lod << EOD
9.958 0.95776
EOD
$servo << EOD
10.059 0.95776
EOD
$windows << EOD
1948 0.95776
17612 0.95776
19329 0.95776
EOD
set title 'Sheet one radius thick' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
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
0.181 15.259
EOD
$stencil << EOD
3.757 2.7884
12.593 3.3662
40.015 4.0355
EOD
$blanch << EOD
11.732 19.847
39.624 4.481
103.74 3.2144
332.09 1.7491
753.89 1.6146
EOD
$energy << EOD
10.109 8.0534
32.632 1.8068
78.356 0.8574
271.91 0.74523
640.93 0.13869
EOD
$lod_blanch << EOD
11 2.9109
EOD
$lod << EOD
8.776 0.66389
EOD
$servo << EOD
8.926 0.66389
EOD
$windows << EOD
850.03 0.66389
11553 0.66389
15374 0.66389
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
unset multiplot
