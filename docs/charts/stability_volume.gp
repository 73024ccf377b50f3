# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_volume.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'The volume force in the closed loop' at screen 0.03,0.965 font ',16'
set label 2 'A ball held at flat clay with 3 N, one tick of delay, 0.15 N of friction, no coupling; P is the point law. At 0.1 (exponent 2) and 0.2 (4), the thinnest tried: quiet at any skin.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set logscale xy
set lmargin at screen 0.065
set rmargin at screen 0.321667
set tmargin at screen 0.85
set bmargin at screen 0.5775
set title 'Thinnest quiet skin, exponent 2, 1 ms' font ',13' offset 0,-0.5
unset key
set xrange [0.1:20]
set xtics ('P' 0.125,'0.25' 0.25,'0.5' 0.5,'1' 1,'2' 2,'4' 4,'8' 8,'16' 16)
set xlabel 'radius of the tool [mm]'
set yrange [0.08:10]
set ylabel 'skin [mm]'
$d0 << EOD
0.125 1.91943
0.25 1.91943
0.5 1.74494
1 1.58631
2 0.1
4 0.1
8 0.1
16 0.1
EOD
$d1 << EOD
0.125 0.984973
0.25 0.984973
0.5 0.89543
1 0.1
2 0.1
4 0.1
8 0.1
16 0.1
EOD
$d2 << EOD
0.125 0.611591
0.25 0.611591
0.5 0.67275
1 0.1
2 0.1
4 0.1
8 0.1
16 0.1
EOD
$d3 << EOD
0.125 0.555992
0.25 0.259374
0.5 0.67275
1 0.1
2 0.1
4 0.1
8 0.1
16 0.1
EOD
plot $d0 with linespoints pt 5 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle, $d1 with linespoints pt 7 ps 0.9 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#0072b2' notitle
unset label 1
unset label 2
set lmargin at screen 0.396667
set rmargin at screen 0.653333
set tmargin at screen 0.85
set bmargin at screen 0.5775
set title 'Thinnest quiet skin, exponent 4, 1 ms' font ',13' offset 0,-0.5
unset key
set xrange [0.1:20]
set xtics ('P' 0.125,'0.25' 0.25,'0.5' 0.5,'1' 1,'2' 2,'4' 4,'8' 8,'16' 16)
set xlabel 'radius of the tool [mm]'
set yrange [0.08:10]
set ylabel 'skin [mm]'
$d0 << EOD
0.125 3.83887
0.25 3.83887
0.5 3.48988
1 2.8842
2 0.2
4 0.2
8 0.2
16 0.2
EOD
$d1 << EOD
0.125 1.96995
0.25 1.96995
0.5 1.62805
1 0.2
2 0.2
4 0.2
8 0.2
16 0.2
EOD
$d2 << EOD
0.125 1.3455
0.25 1.11198
0.5 0.627686
1 0.2
2 0.2
4 0.2
8 0.2
16 0.2
EOD
$d3 << EOD
0.125 1.11198
0.25 0.7595
0.5 0.2
1 0.2
2 0.2
4 0.2
8 0.2
16 0.2
EOD
plot $d0 with linespoints pt 5 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle, $d1 with linespoints pt 7 ps 0.9 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#0072b2' notitle
set lmargin at screen 0.728333
set rmargin at screen 0.985
set tmargin at screen 0.85
set bmargin at screen 0.5775
set title 'Slope at the surface: ball to point' font ',13' offset 0,-0.5
set xrange [0.05:20]
set yrange [0.02:1.5]
set xtics auto
set format x '%g'
set xlabel 'R / skin'
set ylabel 'ratio'
set key left bottom Left reverse samplen 1.6 font ',11'
$d0 << EOD
0.0625 1
0.125 1
0.25 1
0.5 0.999293
1 0.85241
2 0.520715
4 0.275038
8 0.139459
16 0.0699755
EOD
$d1 << EOD
0.0625 1.00234
0.125 1.00935
0.25 1.03053
0.5 0.852628
1 0.517545
2 0.274438
4 0.139377
8 0.0699649
16 0.0350172
EOD
$d2 << EOD
0.5 1
1 0.84
2 0.48
4 0.25
EOD
$d3 << EOD
0.5 0.84
1 0.48
2 0.25
4 0.13
EOD
plot $d0 with linespoints pt 7 ps 0.7 lw 1.8 lc rgb '#000000' title 'exponent 2', $d1 with linespoints pt 7 ps 0.7 lw 1.8 lc rgb '#7f7f7f' title 'exponent 4', $d2 with points pt 2 ps 1.1 lw 1.5 lc rgb '#000000' title 'theory C.1, exponent 2', $d3 with points pt 2 ps 1.1 lw 1.5 lc rgb '#7f7f7f' title 'theory C.1, exponent 4'
set lmargin at screen 0.065
set rmargin at screen 0.321667
set tmargin at screen 0.4475
set bmargin at screen 0.175
set title 'Slope where it cycles, 1 ms' font ',13' offset 0,-0.5
unset key
set xrange [0.1:20]
set xtics ('P' 0.125,'0.25' 0.25,'0.5' 0.5,'1' 1,'2' 2,'4' 4,'8' 8,'16' 16)
set xlabel 'radius of the tool [mm]'
set yrange [200:8e4]
set ylabel 'slope at 3 N [N/m]'
$d0 << EOD
0.125 3438.51
0.25 3438.51
0.5 3438.51
1 3438.51
2 3438.51
4 3438.51
8 3438.51
16 3438.51
EOD
$d1 << EOD
0.125 3438.51
0.25 3431.47
0.5 3744.71
1 3888.58
0.125 3438.51
0.25 3433.25
0.5 3754.61
1 4123.25
EOD
$d2 << EOD
0.125 6700.69
0.25 6700.69
0.5 6700.69
1 6700.69
2 6700.69
4 6700.69
8 6700.69
16 6700.69
EOD
$d3 << EOD
0.125 6700.69
0.25 6648.41
0.5 7043.2
0.125 6700.69
0.25 6662.01
0.5 7573.58
EOD
$d4 << EOD
0.125 10791.5
0.25 10791.5
0.5 10791.5
1 10791.5
2 10791.5
4 10791.5
8 10791.5
16 10791.5
EOD
$d5 << EOD
0.125 10791.5
0.25 10571.7
0.5 11486.4
0.125 9810.49
0.25 11631.8
0.5 11547.3
EOD
$d6 << EOD
0.125 23132.6
0.25 23132.6
0.5 23132.6
1 23132.6
2 23132.6
4 23132.6
8 23132.6
16 23132.6
EOD
$d7 << EOD
0.125 21029.6
0.25 23303.9
0.125 21029.7
0.25 22970.4
EOD
$d8 << EOD
0.25 24364.7
0.5 12692.5
1 6413.03
2 3214.9
4 1608.5
8 804.38
16 402.206
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#d55e00' notitle, $d1 with points pt 5 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle, $d2 with lines lw 1.4 dt 2 lc rgb '#e69f00' notitle, $d3 with points pt 7 ps 0.9 lw 1.8 lc rgb '#e69f00' notitle, $d4 with lines lw 1.4 dt 2 lc rgb '#009e73' notitle, $d5 with points pt 9 ps 0.9 lw 1.8 lc rgb '#009e73' notitle, $d6 with lines lw 1.4 dt 2 lc rgb '#0072b2' notitle, $d7 with points pt 13 ps 0.9 lw 1.8 lc rgb '#0072b2' notitle, $d8 with lines lw 1.8 lc rgb '#a0a0a0' notitle
set lmargin at screen 0.396667
set rmargin at screen 0.653333
set tmargin at screen 0.4475
set bmargin at screen 0.175
set title 'Slope where it cycles, 5 ms' font ',13' offset 0,-0.5
unset key
set xrange [0.1:20]
set xtics ('P' 0.125,'0.25' 0.25,'0.5' 0.5,'1' 1,'2' 2,'4' 4,'8' 8,'16' 16)
set xlabel 'radius of the tool [mm]'
set yrange [200:8e4]
set ylabel 'slope at 3 N [N/m]'
$d0 << EOD
0.125 618.447
0.25 618.447
0.5 618.447
1 618.447
2 618.447
4 618.447
8 618.447
16 618.447
EOD
$d1 << EOD
0.125 618.447
0.25 618.406
0.5 618.283
1 617.791
2 615.821
4 607.875
8 639.074
0.125 618.447
0.25 618.416
0.5 618.324
1 617.956
2 616.492
4 610.721
8 626.296
EOD
$d2 << EOD
0.125 996.015
0.25 996.015
0.5 996.015
1 996.015
2 996.015
4 996.015
8 996.015
16 996.015
EOD
$d3 << EOD
0.125 1095.62
0.25 1095.39
0.5 1094.71
1 1091.97
2 1080.95
4 1146.78
0.125 1095.62
0.25 995.887
0.5 1094.93
1 1092.9
2 1084.87
4 1127.19
EOD
$d4 << EOD
0.125 1604.09
0.25 1604.09
0.5 1604.09
1 1604.09
2 1604.09
4 1604.09
8 1604.09
16 1604.09
EOD
$d5 << EOD
0.125 1604.09
0.25 1603.38
0.5 1601.23
1 1592.62
2 1695.73
0.125 1604.09
0.25 1603.56
0.5 1601.95
1 1595.59
2 1696.14
EOD
$d6 << EOD
0.125 3782.36
0.25 3782.36
0.5 3782.36
1 3782.36
2 3782.36
4 3782.36
8 3782.36
16 3782.36
EOD
$d7 << EOD
0.125 3782.36
0.25 4148.12
0.5 4110.43
1 4172.51
0.125 3782.36
0.25 3775.36
0.5 4123.75
1 4123.25
EOD
$d8 << EOD
0.25 24364.7
0.5 12692.5
1 6413.03
2 3214.9
4 1608.5
8 804.38
16 402.206
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#d55e00' notitle, $d1 with points pt 5 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle, $d2 with lines lw 1.4 dt 2 lc rgb '#e69f00' notitle, $d3 with points pt 7 ps 0.9 lw 1.8 lc rgb '#e69f00' notitle, $d4 with lines lw 1.4 dt 2 lc rgb '#009e73' notitle, $d5 with points pt 9 ps 0.9 lw 1.8 lc rgb '#009e73' notitle, $d6 with lines lw 1.4 dt 2 lc rgb '#0072b2' notitle, $d7 with points pt 13 ps 0.9 lw 1.8 lc rgb '#0072b2' notitle, $d8 with lines lw 1.8 lc rgb '#a0a0a0' notitle
unset label 1
unset label 2
unset logscale
unset border
unset tics
unset xlabel
unset ylabel
unset title
set lmargin at screen 0.03
set rmargin at screen 0.98
set tmargin at screen 0.09
set bmargin at screen 0
set key center top horizontal maxcols 5 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with points pt 5 ps 0.9 lw 1.8 lc rgb '#d55e00' title 'push hand', NaN with points pt 7 ps 0.9 lw 1.8 lc rgb '#e69f00' title 'light hand', NaN with points pt 9 ps 0.9 lw 1.8 lc rgb '#009e73' title 'arm hand', NaN with points pt 13 ps 0.9 lw 1.8 lc rgb '#0072b2' title 'firm hand', NaN with lines lw 1.8 lc rgb '#a0a0a0' title 'steepest that a ball feels', NaN with lines lw 1.4 dt 2 lc rgb '#d55e00' title 'linear wall, push', NaN with lines lw 1.4 dt 2 lc rgb '#e69f00' title 'linear wall, light', NaN with lines lw 1.4 dt 2 lc rgb '#009e73' title 'linear wall, arm', NaN with lines lw 1.4 dt 2 lc rgb '#0072b2' title 'linear wall, firm'
unset multiplot
