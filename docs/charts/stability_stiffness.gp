# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_stiffness.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'How stiff a wall may be: period of the servo, hand and remedy' at screen 0.03,0.965 font ',16'
set label 2 'Hold of 3 N at a linear wall, one tick of delay, simulated Falcon with 0.15 N of friction. At the top edge: no failure up to 60000 N/m.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set xrange [0.2:25]
set yrange [50:8e4]
set xtics (0.25,0.5,1,2,5,10,20)
set lmargin at screen 0.065
set rmargin at screen 0.28
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'push hand' font ',13' offset 0,-0.5
set format y '%g'
set ylabel 'first limit cycle [N/m]'
unset xlabel
$d0 << EOD
0.25 23132.6
0.5 8918.62
1 3438.51
2 1458.27
5 618.447
10 317.361
20 197.056
EOD
$d1 << EOD
0.25 511.113
0.5 511.113
1 464.648
2 422.408
5 349.097
10 262.282
20 179.142
EOD
$d2 << EOD
0.25 996.015
0.5 905.468
1 823.153
2 680.292
5 464.648
10 288.51
20 179.142
EOD
$d3 << EOD
0.25 49586.8
0.5 25445.9
1 11870.7
2 5034.33
5 1764.5
10 823.153
20 317.361
EOD
$d4 << EOD
0.25 60000
0.5 40980.8
1 19117.8
2 8918.62
5 2583.41
10 905.468
20 216.762
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 49586.8
5 996.015
10 422.408
20 216.762
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 9810.48
0.5 4576.66
1 2348.55
2 1205.18
5 464.648
10 238.438
20 111.233
EOD
$d8 << EOD
0.25 10606.4
0.5 5306.36
1 2656.36
2 1331.34
5 536.293
10 271.212
20 138.552
EOD
$d9 << EOD
0.25 10600
0.5 5300
1 2650
2 1325
5 530
10 265
20 132.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
unset label 1
unset label 2
set lmargin at screen 0.3
set rmargin at screen 0.515
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'light hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
unset xlabel
$d0 << EOD
0.25 37255.3
0.5 15799.9
1 6700.69
2 2841.75
5 996.015
10 511.113
20 288.51
EOD
$d1 << EOD
0.25 905.468
0.5 823.153
1 823.153
2 748.321
5 562.224
10 422.408
20 288.51
EOD
$d2 << EOD
0.25 1604.09
0.5 1458.27
1 1325.7
2 1205.18
5 748.321
10 464.648
20 288.51
EOD
$d3 << EOD
0.25 60000
0.5 30789.5
1 14363.5
2 6700.69
5 2348.55
10 996.015
20 422.408
EOD
$d4 << EOD
0.25 60000
0.5 49586.8
1 23132.6
2 9810.48
5 3125.92
10 1205.18
20 317.361
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 2841.75
10 823.153
20 349.097
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 17379.9
0.5 8918.62
1 4576.66
2 2135.05
5 823.153
10 422.408
20 216.762
EOD
$d8 << EOD
0.25 18616.2
0.5 9316.26
1 4666.4
2 2341.69
5 947.541
10 483.95
20 254.244
EOD
$d9 << EOD
0.25 18600
0.5 9300
1 4650
2 2325
5 930
10 465
20 232.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.535
set rmargin at screen 0.75
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'arm hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
unset xlabel
$d0 << EOD
0.25 60000
0.5 25445.9
1 10791.5
2 4576.66
5 1604.09
10 748.321
20 422.408
EOD
$d1 << EOD
0.25 1325.7
0.5 1325.7
1 1205.18
2 1095.62
5 823.153
10 618.447
20 384.007
EOD
$d2 << EOD
0.25 2135.05
0.5 1940.95
1 1764.5
2 1604.09
5 1095.62
10 680.292
20 422.408
EOD
$d3 << EOD
0.25 60000
0.5 40980.8
1 19117.8
2 8107.83
5 3125.92
10 1325.7
20 618.447
EOD
$d4 << EOD
0.25 60000
0.5 60000
1 25445.9
2 11870.7
5 4160.6
10 1764.5
20 618.447
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 1458.27
20 562.224
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 27990.4
0.5 13057.7
1 6700.69
2 3125.92
5 1205.18
10 618.447
20 317.361
EOD
$d8 << EOD
0.25 27819.9
0.5 13920
1 6970.19
2 3495.51
5 1411.48
10 718.084
20 373.765
EOD
$d9 << EOD
0.25 27800
0.5 13900
1 6950
2 3475
5 1390
10 695
20 347.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.77
set rmargin at screen 0.985
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'firm hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
unset xlabel
$d0 << EOD
0.25 60000
0.5 45078.9
1 23132.6
2 9810.48
5 3782.36
10 1940.95
20 1095.62
EOD
$d1 << EOD
0.25 3782.36
0.5 3782.36
1 3438.51
2 3125.92
5 2348.55
10 1604.09
20 1095.62
EOD
$d2 << EOD
0.25 5537.76
0.5 5537.76
1 5034.33
2 4160.6
5 2841.75
10 1764.5
20 1095.62
EOD
$d3 << EOD
0.25 60000
0.5 60000
1 27990.4
2 13057.7
5 5034.33
10 2348.55
20 1095.62
EOD
$d4 << EOD
0.25 60000
0.5 60000
1 37255.3
2 17379.9
5 6091.54
10 2583.41
20 996.015
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 3438.51
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 60000
0.5 33868.4
1 15799.9
2 7370.76
5 3438.51
10 1764.5
20 996.015
EOD
$d8 << EOD
0.25 64074.5
0.5 32108.9
1 16127.5
2 8139.74
5 3356.29
10 1776.87
20 1014.69
EOD
$d9 << EOD
0.25 63933.3
0.5 31966.7
1 15983.3
2 7991.67
5 3196.67
10 1598.33
20 799.167
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.065
set rmargin at screen 0.28
set tmargin at screen 0.4925
set bmargin at screen 0.205
set title 'push hand' font ',13' offset 0,-0.5
set format y '%g'
set ylabel 'first that is not quiet [N/m]'
set xlabel 'period [ms]'
$d0 << EOD
0.25 9810.48
0.5 8918.62
1 3438.51
2 1458.27
5 618.447
10 317.361
20 197.056
EOD
$d1 << EOD
0.25 511.113
0.5 511.113
1 464.648
2 422.408
5 349.097
10 262.282
20 179.142
EOD
$d2 << EOD
0.25 996.015
0.5 905.468
1 823.153
2 680.292
5 464.648
10 288.51
20 179.142
EOD
$d3 << EOD
0.25 11870.7
0.5 19117.8
1 9810.48
2 5034.33
5 1764.5
10 823.153
20 317.361
EOD
$d4 << EOD
0.25 6091.54
0.5 6091.54
1 6091.54
2 8107.83
5 2583.41
10 905.468
20 216.762
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 49586.8
5 996.015
10 422.408
20 216.762
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 7370.76
0.5 4160.6
1 2348.55
2 1205.18
5 464.648
10 238.438
20 111.233
EOD
$d8 << EOD
0.25 10606.4
0.5 5306.36
1 2656.36
2 1331.34
5 536.293
10 271.212
20 138.552
EOD
$d9 << EOD
0.25 10600
0.5 5300
1 2650
2 1325
5 530
10 265
20 132.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.3
set rmargin at screen 0.515
set tmargin at screen 0.4925
set bmargin at screen 0.205
set title 'light hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
set xlabel 'period [ms]'
$d0 << EOD
0.25 11870.7
0.5 9810.48
1 6700.69
2 2841.75
5 996.015
10 511.113
20 288.51
EOD
$d1 << EOD
0.25 905.468
0.5 823.153
1 823.153
2 748.321
5 562.224
10 422.408
20 288.51
EOD
$d2 << EOD
0.25 1604.09
0.5 1458.27
1 1325.7
2 1205.18
5 748.321
10 464.648
20 288.51
EOD
$d3 << EOD
0.25 30789.5
0.5 8107.83
1 11870.7
2 6091.54
5 2348.55
10 996.015
20 422.408
EOD
$d4 << EOD
0.25 11870.7
0.5 6091.54
1 6091.54
2 6091.54
5 3125.92
10 1205.18
20 317.361
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 2841.75
10 823.153
20 349.097
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 8918.62
0.5 7370.76
1 4160.6
2 2135.05
5 823.153
10 422.408
20 216.762
EOD
$d8 << EOD
0.25 18616.2
0.5 9316.26
1 4666.4
2 2341.69
5 947.541
10 483.95
20 254.244
EOD
$d9 << EOD
0.25 18600
0.5 9300
1 4650
2 2325
5 930
10 465
20 232.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.535
set rmargin at screen 0.75
set tmargin at screen 0.4925
set bmargin at screen 0.205
set title 'arm hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
set xlabel 'period [ms]'
$d0 << EOD
0.25 19117.8
0.5 14363.5
1 9810.48
2 4576.66
5 1604.09
10 748.321
20 422.408
EOD
$d1 << EOD
0.25 1325.7
0.5 1325.7
1 1205.18
2 1095.62
5 823.153
10 618.447
20 384.007
EOD
$d2 << EOD
0.25 2135.05
0.5 1940.95
1 1764.5
2 1604.09
5 1095.62
10 680.292
20 422.408
EOD
$d3 << EOD
0.25 11870.7
0.5 19117.8
1 14363.5
2 8107.83
5 3125.92
10 1325.7
20 618.447
EOD
$d4 << EOD
0.25 19117.8
0.5 14363.5
1 6091.54
2 8107.83
5 4160.6
10 1764.5
20 618.447
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 1458.27
20 562.224
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 8918.62
0.5 8107.83
1 4576.66
2 3125.92
5 1205.18
10 618.447
20 317.361
EOD
$d8 << EOD
0.25 27819.9
0.5 13920
1 6970.19
2 3495.51
5 1411.48
10 718.084
20 373.765
EOD
$d9 << EOD
0.25 27800
0.5 13900
1 6950
2 3475
5 1390
10 695
20 347.5
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
set lmargin at screen 0.77
set rmargin at screen 0.985
set tmargin at screen 0.4925
set bmargin at screen 0.205
set title 'firm hand' font ',13' offset 0,-0.5
set format y ''
unset ylabel
set xlabel 'period [ms]'
$d0 << EOD
0.25 30789.5
0.5 9810.48
1 11870.7
2 9810.48
5 3782.36
10 1940.95
20 1095.62
EOD
$d1 << EOD
0.25 3782.36
0.5 3782.36
1 3438.51
2 3125.92
5 2348.55
10 1604.09
20 1095.62
EOD
$d2 << EOD
0.25 5537.76
0.5 5537.76
1 5034.33
2 4160.6
5 2841.75
10 1764.5
20 1095.62
EOD
$d3 << EOD
0.25 30789.5
0.5 8107.83
1 8107.83
2 11870.7
5 5034.33
10 2348.55
20 1095.62
EOD
$d4 << EOD
0.25 30789.5
0.5 8107.83
1 11870.7
2 11870.7
5 6091.54
10 2583.41
20 996.015
EOD
$d5 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 3438.51
EOD
$d6 << EOD
0.25 60000
0.5 60000
1 60000
2 60000
5 60000
10 60000
20 60000
EOD
$d7 << EOD
0.25 8918.62
0.5 8918.62
1 8918.62
2 7370.76
5 3438.51
10 1764.5
20 996.015
EOD
$d8 << EOD
0.25 64074.5
0.5 32108.9
1 16127.5
2 8139.74
5 3356.29
10 1776.87
20 1014.69
EOD
$d9 << EOD
0.25 63933.3
0.5 31966.7
1 15983.3
2 7991.67
5 3196.67
10 1598.33
20 799.167
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d5 with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' notitle, $d6 with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' notitle, $d7 with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#606060' notitle, $d9 with lines lw 1.5 dt 3 lc rgb '#b00000' notitle
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
set tmargin at screen 0.125
set bmargin at screen 0
set key center top horizontal maxcols 4 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' title 'direct', NaN with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#e69f00' title 'force filter, 0.1 per ms', NaN with linespoints pt 11 ps 0.75 lw 1.8 lc rgb '#cc79a7' title 'position filter, τ 0.1, λ 1 mm', NaN with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' title 'viscosity 10 N s/m', NaN with linespoints pt 13 ps 0.75 lw 1.8 lc rgb '#009e73' title 'passivity controller', NaN with linespoints pt 4 ps 0.75 lw 1.8 lc rgb '#0072b2' title 'coupling 1500 N/m, not governed', NaN with linespoints pt 3 ps 0.75 lw 1.8 lc rgb '#d55e00' title 'default: coupling, governed', NaN with points pt 6 ps 1.2 lw 1.5 lc rgb '#000000' title 'direct, no friction', NaN with lines lw 1.5 dt 2 lc rgb '#606060' title 'eigenvalue, no friction', NaN with lines lw 1.5 dt 3 lc rgb '#b00000' title '(b + b_hand)/(T/2 + delay)'
unset multiplot
