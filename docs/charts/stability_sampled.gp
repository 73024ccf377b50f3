# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,900 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_sampled.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Clay served in windows, held and carved' at screen 0.03,0.965 font ',16'
set label 2 'Flat clay of 0.5 mm voxels, 1 kHz, one tick of delay, 0.15 N of friction. A mark for each tool, skin, exponent and hand; the lower edge: nothing.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set lmargin at screen 0.07
set rmargin at screen 0.4825
set tmargin at screen 0.85
set bmargin at screen 0.56
set title 'Held with 3 N' font ',13' offset 0,-0.5
set key Left reverse samplen 1.6 font ',11' opaque left top
set logscale xy
set xrange [200:20000]
set yrange [8e-4:100]
set xlabel 'slope where it rests [N/m]'
set ylabel 'swing [mm]'
$d0 << EOD
200 0.18
20000 0.18
EOD
$d1 << EOD
5846.83 3.72287
1497.66 0.001
374.963 0.001
4900.83 3.11292
1490.62 0.001
374.854 0.001
2991.03 0.001
1461.71 0.001
374.415 0.001
401.749 0.001
394.858 0.001
306.302 0.001
5846.83 0.001
1497.66 0.001
374.963 0.001
4900.83 0.001
1490.62 0.001
374.854 0.001
2991.03 0.001
1461.71 0.001
374.415 0.001
401.749 0.001
394.858 0.001
306.302 0.001
9611.09 3.82344
2986.09 0.001
749.781 0.001
5913.78 3.44931
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 1.79532
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 0.001
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 0.001
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
EOD
$d2 << EOD
9611.09 2.39062
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 1.04317
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 0.001
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
9611.09 0.001
2986.09 0.001
749.781 0.001
5913.78 0.001
2937.37 0.001
749.125 0.001
3148.43 0.001
2402.77 0.001
746.522 0.001
402.076 0.001
400.028 0.001
369.611 0.001
EOD
$d3 << EOD
9611.09 0.001
749.781 0.001
5913.78 0.001
749.125 0.001
3148.43 0.001
746.522 0.001
402.076 0.001
369.611 0.001
9611.09 0.001
749.781 0.001
5913.78 0.001
749.125 0.001
3148.43 0.001
746.522 0.001
402.076 0.001
369.611 0.001
9611.09 0.001
749.781 0.001
5913.78 0.001
749.125 0.001
3148.43 0.001
746.522 0.001
402.076 0.001
369.611 0.001
9611.09 0.001
749.781 0.001
5913.78 0.001
749.125 0.001
3148.43 0.001
746.522 0.001
402.076 0.001
369.611 0.001
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#606060' title 'limit cycle', $d1 with points pt 6 ps 0.9 lw 1.6 lc rgb '#000000' title 'direct, contact alone', $d2 with points pt 2 ps 0.9 lw 1.6 lc rgb '#0072b2' title 'direct, with drag', $d3 with points pt 3 ps 0.9 lw 1.6 lc rgb '#d55e00' title 'default servo'
unset label 1
unset label 2
set lmargin at screen 0.5725
set rmargin at screen 0.985
set tmargin at screen 0.85
set bmargin at screen 0.56
set title 'While carving: chatter of the force' font ',13' offset 0,-0.5
set key Left reverse samplen 1.6 font ',11' opaque right top
set xrange [0.3:30]
set yrange [8e-3:20]
set xtics ('0.5' 0.5,'1' 1,'2' 2,'16' 16)
set xlabel 'radius of the tool [mm]'
set ylabel 'force p-p in 50 ms [N]'
$d0 << EOD
0.3 0.5
30 0.5
EOD
$d1 << EOD
0.44 1.36356
0.88 1.17762
1.76 0.992495
14.08 0.429118
0.44 1.36052
0.88 1.1823
1.76 0.99392
14.08 0.333463
0.44 1.34974
0.88 1.2327
1.76 0.992872
14.08 0.345009
0.44 1.3492
0.88 1.24136
1.76 1.04427
14.08 0.256895
EOD
$d2 << EOD
0.5 0.439826
0.5 0.443048
0.5 0.464668
1 0.237181
1 0.337159
1 0.338481
2 0.132208
2 0.235582
2 0.185489
16 0.146356
16 0.112352
16 0.166688
0.5 0.406819
0.5 0.429456
0.5 0.467856
1 0.208566
1 0.351405
1 0.377623
2 0.132782
2 0.238772
2 0.26159
16 0.148595
16 0.100029
16 0.153302
0.5 0.389053
0.5 0.435718
0.5 0.464908
1 0.203536
1 0.355889
1 0.335998
2 0.156993
2 0.17475
2 0.324466
16 0.139046
16 0.113555
16 0.166458
0.5 0.449313
0.5 0.468013
0.5 0.464086
1 0.242891
1 0.351054
1 0.314681
2 0.136578
2 0.244432
2 0.190547
16 0.19725
16 0.129317
16 0.143827
0.5 0.426349
0.5 0.454841
0.5 0.448793
1 0.278869
1 0.345295
1 0.353968
2 0.161249
2 0.283715
2 0.321338
16 0.0550415
16 0.0633703
16 0.161474
EOD
$d3 << EOD
0.57 0.0873862
0.57 0.092623
1.14 0.0743816
1.14 0.0857327
2.28 0.0709075
2.28 0.0714844
18.24 0.09655
18.24 0.0941616
0.57 0.0932418
0.57 0.0830745
1.14 0.091662
1.14 0.0791339
2.28 0.0648038
2.28 0.0913606
18.24 0.135684
18.24 0.095561
0.57 0.0948533
0.57 0.0860345
1.14 0.0652187
1.14 0.0848053
2.28 0.0605848
2.28 0.0600793
18.24 0.112978
18.24 0.111341
0.57 0.0808596
0.57 0.0836966
1.14 0.0618512
1.14 0.0844218
2.28 0.0800027
2.28 0.0579459
18.24 0.0484183
18.24 0.0927813
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#606060' title 'buzz', $d1 with points pt 4 ps 0.9 lw 1.6 lc rgb '#cc79a7' title 'direct, raw velocities', $d2 with points pt 6 ps 0.9 lw 1.6 lc rgb '#000000' title 'direct, mean of 3 ms', $d3 with points pt 3 ps 0.9 lw 1.6 lc rgb '#d55e00' title 'default servo'
set lmargin at screen 0.07
set rmargin at screen 0.4825
set tmargin at screen 0.4
set bmargin at screen 0.11
set title 'Slope at the first limit cycle, direct' font ',13' offset 0,-0.5
set key Left reverse samplen 1.6 font ',11' opaque right top
unset logscale x
set yrange [1000:60000]
set xlabel 'radius of the tool, exponent, hand' offset 0,-0.6
set ylabel 'slope where it rests [N/m]'
set xtics ("0.5 mm, e 2\npush" 1,"0.5 mm, e 2\nlight" 2,"1 mm, e 2\npush" 3,"0.5 mm, e 4\npush" 4,"0.5 mm, e 4\nlight" 5,"1 mm, e 4\npush" 6)
set xrange [0.4:6.6]
$d0 << EOD
1 3438.51
2 6700.69
3 3438.51
4 3438.51
5 6700.69
6 3438.51
EOD
$d1 << EOD
1 3744.71
2 7043.2
3 3888.58
4 3754.61
5 7573.58
6 4123.25
EOD
$d2 << EOD
1 3744.71
2 7043.2
3 3888.58
4 3754.61
5 7573.58
6 4123.25
EOD
$d3 << EOD
1 5930.54
2 9266.69
3 6113.87
4 6489.47
5 9561.22
6 6061.79
EOD
plot $d0 with points pt 2 ps 1.3 lw 1.6 lc rgb '#606060' title 'linear wall', $d1 with points pt 6 ps 1.6 lw 1.6 lc rgb '#e69f00' title 'closed form', $d2 with points pt 7 ps 0.9 lw 1.6 lc rgb '#000000' title 'sampled, contact alone', $d3 with points pt 2 ps 0.9 lw 1.6 lc rgb '#0072b2' title 'sampled, with drag'
set lmargin at screen 0.5725
set rmargin at screen 0.985
set tmargin at screen 0.4
set bmargin at screen 0.11
set title 'Sliding through cells at 3 N' font ',13' offset 0,-0.5
set key Left reverse samplen 1.6 font ',11' opaque right top
set logscale x
set xrange [0.15:6]
set yrange [1e-3:1000]
set xtics ('0.25' 0.25,'0.5' 0.5,'1' 1,'4' 4)
set xlabel 'cell [mm], a quarter of the radius'
set ylabel 'ripple p-p [% of the force]'
$d0 << EOD
0.15 1.4
6 1.4
EOD
$d1 << EOD
0.15 0.09
6 0.09
EOD
$d2 << EOD
0.25 0.0460374
0.5 0.047802
1 0.0485867
4 0.0353183
EOD
$d3 << EOD
0.25 0.0135346
0.5 0.0177769
1 0.0269057
4 0.0334307
EOD
$d4 << EOD
0.25 0.00987006
0.5 0.0106767
1 0.0103703
4 0.00979621
EOD
$d5 << EOD
0.25 0.00777159
0.5 0.00800826
1 0.00911263
4 0.0108254
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#606060' title 'theory C.4, smooth, 8 nodes', $d1 with lines lw 1.4 dt 3 lc rgb '#606060' title 'theory C.4, smooth, 16 nodes', $d2 with linespoints pt 5 ps 0.9 lw 1.6 lc rgb '#d55e00' title 'leaning 20 degrees, e 4, skin 1 mm', $d3 with linespoints pt 7 ps 0.9 lw 1.6 lc rgb '#e69f00' title 'leaning, e 2, skin 8 mm', $d4 with linespoints pt 9 ps 0.9 lw 1.6 lc rgb '#0072b2' title 'along the cells, e 4, skin 1 mm', $d5 with linespoints pt 13 ps 0.9 lw 1.6 lc rgb '#56b4e9' title 'along the cells, e 2, skin 8 mm'
unset multiplot
