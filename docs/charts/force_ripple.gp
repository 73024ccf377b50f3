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
set label 2 'Balls and 4:1 ellipsoids, radius 4 to 128 finest voxels, e = 1, 2, 4; half a radius deep, sliding three cells of the method’s own lattice.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
0.14 1.3725
EOD
$stencil << EOD
2.834 0.085718
8.352 0.061667
22.103 0.032504
EOD
$blanch << EOD
8.943 3.1166
29.754 0.40651
71.155 0.13488
247.04 0.036037
579.47 0.019362
EOD
$energy << EOD
6.97 1.1703
22.924 0.18449
52.939 0.050557
187.71 0.017694
435.04 0.009468
EOD
$lod_blanch << EOD
4.167 0.091587
EOD
$lod << EOD
3.474 0.04962
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
0.14 18.348
EOD
$stencil << EOD
2.834 3.0822
8.352 3.1141
22.103 4.6922
EOD
$blanch << EOD
8.993 11.305
29.865 6.26
71.346 3.7526
246.36 1.809
580.59 1.0081
EOD
$energy << EOD
7.02 2.5541
22.463 0.77669
52.958 0.63408
186.78 0.49822
435.6 0.40072
EOD
$lod_blanch << EOD
4.166 2.9185
EOD
$lod << EOD
3.456 0.58631
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
0.14 33.232
EOD
$stencil << EOD
2.834 4.4743
8.352 3.0332
22.103 3.3088
EOD
$blanch << EOD
9.014 2.4376
30.074 1.3062
71.126 0.80175
247.45 0.47759
573.3 0.34508
EOD
$energy << EOD
7.01 1.2226
23.365 0.49722
52.919 0.3699
187.3 0.22876
433.86 0.16413
EOD
$lod_blanch << EOD
4.147 0.65305
EOD
$lod << EOD
3.455 0.30181
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
0.14 62.799
EOD
$stencil << EOD
2.834 7.9853
8.352 4.7025
22.103 5.0491
EOD
$blanch << EOD
8.723 17.77
29.684 10.856
70.946 7.8004
245.46 4.2523
575.28 2.552
EOD
$energy << EOD
6.95 10.107
22.954 1.9698
52.958 1.6778
187 1.2264
434.83 0.95027
EOD
$lod_blanch << EOD
4.166 8.1526
EOD
$lod << EOD
3.465 1.5095
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
0.14 13.401
EOD
$stencil << EOD
2.834 0.95962
8.352 1.6751
22.103 0.73847
EOD
$blanch << EOD
9.003 3.8704
29.794 1.389
71.306 1.1239
247.66 0.81042
581.24 0.62731
EOD
$energy << EOD
6.981 2.2869
23.325 1.7293
52.999 1.3183
188.64 0.90533
435.56 0.68591
EOD
$lod_blanch << EOD
4.187 0.99342
EOD
$lod << EOD
3.475 1.1528
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
0.14 20.976
EOD
$stencil << EOD
2.834 2.7884
8.352 3.3662
22.103 4.0355
EOD
$blanch << EOD
9.004 19.814
29.834 4.4451
71.226 3.2546
245.87 1.7034
575.36 1.6216
EOD
$energy << EOD
6.981 8.0704
22.825 1.887
52.849 1.0092
187.81 0.91579
433.51 0.18206
EOD
$lod_blanch << EOD
4.167 2.882
EOD
$lod << EOD
3.475 0.7958
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod (default)'
unset label 1
unset label 2
unset multiplot
