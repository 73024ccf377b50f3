# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,720 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_ripple.svg'
set logscale xy
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: ripple against time (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4. Half a radius deep, sliding three cells of the method’s own lattice.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set xrange [0.08:2e4]
set yrange [1e-3:1e3]
set multiplot
set lmargin at screen 0.075
set rmargin at screen 0.28
set tmargin at screen 0.84
set bmargin at screen 0.53
set format y '%g'
set ylabel 'ripple while sliding, rms, p95 [%]'
unset xlabel
$point << EOD
0.14 0.86674
EOD
$stencil << EOD
2.824 0.11616
8.343 0.07549
22.123 0.032504
EOD
$blanch << EOD
9.565 3.1166
31.536 0.40651
74.982 0.13488
175.12 0.036037
625.46 0.019362
EOD
$energy << EOD
8.592 2.2018
28.692 0.36918
68.362 0.086401
190.16 0.018495
566.53 0.0061892
EOD
$lod_blanch << EOD
5.588 0.091587
EOD
$lod << EOD
4.316 0.077624
EOD
set title 'Smooth: plane, ball, torus' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35 font ',11'
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
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
0.14 51.429
EOD
$stencil << EOD
2.824 3.0679
8.343 3.0793
22.123 4.6922
EOD
$blanch << EOD
9.995 9.1671
31.667 4.7082
79.378 2.6685
170.89 1.3028
640.17 0.73968
EOD
$energy << EOD
8.733 4.7934
28.292 0.77669
67.611 0.19752
189.42 0.14622
557.3 0.114
EOD
$lod_blanch << EOD
5.598 2.6759
EOD
$lod << EOD
4.246 0.17097
EOD
set title 'Edge of 90°' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
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
0.14 32.14
EOD
$stencil << EOD
2.824 3.2069
8.343 3.0332
22.123 1.7965
EOD
$blanch << EOD
9.985 1.2525
31.998 0.59584
76.363 0.31554
179.27 0.18828
604.77 0.14008
EOD
$energy << EOD
8.532 1.2226
27.02 0.36326
71.266 0.27625
189.95 0.19234
574.28 0.1462
EOD
$lod_blanch << EOD
5.528 0.31481
EOD
$lod << EOD
4.247 0.24374
EOD
set title 'Rough plane' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
unset label 1
unset label 2
set lmargin at screen 0.075
set rmargin at screen 0.28
set tmargin at screen 0.4
set bmargin at screen 0.09
set format y '%g'
set ylabel 'ripple while sliding, rms, p95 [%]'
set xlabel 'median time of a query [µs]'
$point << EOD
0.14 167.29
EOD
$stencil << EOD
2.824 10.017
8.343 7.7955
22.123 5.3347
EOD
$blanch << EOD
9.324 17.77
31.398 10.856
71.736 7.8004
176.84 4.2523
604.2 2.552
EOD
$energy << EOD
8.722 13.409
28.502 1.8174
71.296 1.2507
189.97 0.96282
553.44 0.75408
EOD
$lod_blanch << EOD
5.227 8.1526
EOD
$lod << EOD
4.076 1.1114
EOD
set title 'Slot one radius wide' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
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
0.14 2.4077
EOD
$stencil << EOD
2.824 1.4503
8.343 1.6991
22.123 0.75172
EOD
$blanch << EOD
9.554 3.8704
31.096 1.1663
75.804 0.76541
178.07 0.56907
618.23 0.44797
EOD
$energy << EOD
8.733 4.8382
28.022 1.7691
67.431 1.3748
189.84 0.9294
553.93 0.70642
EOD
$lod_blanch << EOD
5.77 0.68411
EOD
$lod << EOD
4.336 1.1955
EOD
set title 'Sheet one radius thick' font ',13' offset 0,-0.4
unset object 1
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
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
0.14 43.406
EOD
$stencil << EOD
2.824 8.2758
8.343 12.581
22.123 8.7493
EOD
$blanch << EOD
9.235 46.684
31.196 32.253
73.389 33.372
171.22 34.848
610 32.334
EOD
$energy << EOD
8.403 8.7142
26.179 2.7514
61.042 2.9829
190.11 2.6223
518.45 2.4595
EOD
$lod_blanch << EOD
5.277 32.305
EOD
$lod << EOD
4.057 2.3791
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
unset label 1
unset label 2
unset multiplot
