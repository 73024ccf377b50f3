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
0.381 0.4025
EOD
$stencil << EOD
3.737 0.085718
13.025 0.061667
40.446 0.032504
EOD
$blanch << EOD
15.02 3.0304
50.995 0.43723
128.13 0.1904
426.58 0.096455
996.78 0.036649
EOD
$energy << EOD
10.179 1.1759
33.844 0.22803
80.812 0.069995
278.54 0.023869
651.76 0.017062
EOD
$lod_blanch << EOD
11.743 0.14364
EOD
$lod << EOD
9.538 0.065713
EOD
$servo << EOD
8.887 0.065713
EOD
$windows << EOD
2502.7 0.065713
20526 0.065713
21107 0.065713
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
0.38 17.966
EOD
$stencil << EOD
3.737 3.0822
13.025 3.1141
40.446 4.6922
EOD
$blanch << EOD
15.309 11.251
51.706 6.07
130.97 3.6544
429.36 1.7386
1018.5 0.99109
EOD
$energy << EOD
10.119 2.5546
34.415 0.78308
83.847 0.30743
286.91 0.14434
683.36 0.093478
EOD
$lod_blanch << EOD
11.861 2.8035
EOD
$lod << EOD
9.748 0.23217
EOD
$servo << EOD
9.838 0.23217
EOD
$windows << EOD
1465.3 0.23217
24058 0.23217
24470 0.23217
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
0.431 33.235
EOD
$stencil << EOD
3.737 4.4743
13.025 3.0332
40.446 3.3088
EOD
$blanch << EOD
15.699 2.3157
53.482 1.154
133.01 0.72859
436.5 0.41214
1028.6 0.29611
EOD
$energy << EOD
10.49 1.3036
35.807 0.67907
83.348 0.58548
292.49 0.42015
674.71 0.32978
EOD
$lod_blanch << EOD
12.073 0.58405
EOD
$lod << EOD
10.009 0.51282
EOD
$servo << EOD
10.129 0.51282
EOD
$windows << EOD
1753.5 0.51282
9645.6 0.51282
21210 0.51282
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
0.371 62.893
EOD
$stencil << EOD
3.737 7.9853
13.025 4.7025
40.446 5.0491
EOD
$blanch << EOD
14.977 17.771
50.505 10.615
124.96 7.7985
417.18 4.1808
971.95 2.5514
EOD
$energy << EOD
9.848 10.305
32.961 1.3405
79.31 1.3582
272.26 1.2471
641.32 0.77372
EOD
$lod_blanch << EOD
11.762 8.1502
EOD
$lod << EOD
9.488 1.0946
EOD
$servo << EOD
9.528 1.0946
EOD
$windows << EOD
1428.9 1.0946
12496 1.0946
25809 1.0946
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
0.42 1.623
EOD
$stencil << EOD
3.737 0.95962
13.025 1.6751
40.446 0.73847
EOD
$blanch << EOD
15.148 3.8869
50.435 0.85083
125 0.31041
412.88 0.12132
972.65 0.092168
EOD
$energy << EOD
10.59 1.8665
34.905 0.27008
81.711 0.20802
285.01 0.12419
664.3 0.09526
EOD
$lod_blanch << EOD
12.402 0.306
EOD
$lod << EOD
9.95 0.21636
EOD
$servo << EOD
10.198 0.21636
EOD
$windows << EOD
1350.5 0.21636
19266 0.21636
23412 0.21636
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
0.37 15.259
EOD
$stencil << EOD
3.737 2.7884
13.025 3.3662
40.446 4.0355
EOD
$blanch << EOD
14.988 19.847
50.895 4.4794
127.2 3.2108
423.69 1.7475
986.2 1.6146
EOD
$energy << EOD
9.689 8.0534
32.099 1.8197
76.123 0.8574
263.54 0.76208
623.02 0.13611
EOD
$lod_blanch << EOD
11.051 2.9109
EOD
$lod << EOD
8.977 0.66389
EOD
$servo << EOD
9.166 0.66389
EOD
$windows << EOD
716.55 0.66389
10296 0.66389
10891 0.66389
EOD
set title 'Stanford bunny' font ',13' offset 0,-0.4
set object 1 rect from graph 0, graph 0 to 8, 0.5 behind fc rgb '#e8f4e6' fs solid noborder
unset key
plot $point with points pt 9 ps 1.1 lc rgb '#7f7f7f' title 'point: the tool’s centre', $stencil with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil: 96, 288, 768 points', $blanch with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch: lattice, N = 4, 6, 8 …', $energy with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy: lattice, N = 4, 6, 8 …', $lod_blanch with points pt 13 ps 1.3 lc rgb '#cc79a7' title 'lod, blanch law', $lod with points pt 13 ps 1.8 lc rgb '#d55e00' title 'lod', $servo with points pt 12 ps 1.8 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title 'servo + window: move, dab, new'
unset label 1
unset label 2
unset multiplot
