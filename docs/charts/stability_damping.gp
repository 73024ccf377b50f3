# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,820 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_damping.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Adaptive damping: the first stiffness that fails, and the time to settle' at screen 0.03,0.965 font ',16'
set label 2 'Hold of 3 N at a linear wall, one tick of delay, simulated Falcon with 0.15 N of friction. Below: 1 kHz; a gap: it never comes to rest.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set lmargin at screen 0.065
set rmargin at screen 0.28
set tmargin at screen 0.86
set bmargin at screen 0.5725
set title 'push hand' font ',13' offset 0,-0.5
set xrange [0.2:25]
set yrange [50:8e4]
set xtics (0.25,0.5,1,2,5,10,20)
set xlabel 'period [ms]'
set format y '%g'
set ylabel 'first limit cycle [N/m]'
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
0.25 40980.8
0.5 19117.8
1 9810.48
2 4576.66
5 1604.09
10 680.292
20 288.51
EOD
$d2 << EOD
0.25 60000
0.5 40980.8
1 21029.6
2 8918.62
5 1940.95
10 42.8852
20 42.8852
EOD
$d3 << EOD
0.25 60000
0.5 40980.8
1 21029.6
2 9810.48
5 2348.55
10 748.321
20 197.056
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
unset label 1
unset label 2
set lmargin at screen 0.3
set rmargin at screen 0.515
set tmargin at screen 0.86
set bmargin at screen 0.5725
set title 'light hand' font ',13' offset 0,-0.5
set xrange [0.2:25]
set yrange [50:8e4]
set xtics (0.25,0.5,1,2,5,10,20)
set xlabel 'period [ms]'
set format y ''
unset ylabel
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
0.25 49586.8
0.5 25445.9
1 11870.7
2 5537.76
5 2135.05
10 905.468
20 384.007
EOD
$d2 << EOD
0.25 60000
0.5 49586.8
1 23132.6
2 11870.7
5 3125.92
10 238.438
20 42.8852
EOD
$d3 << EOD
0.25 60000
0.5 45078.9
1 23132.6
2 11870.7
5 3125.92
10 996.015
20 288.51
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.535
set rmargin at screen 0.75
set tmargin at screen 0.86
set bmargin at screen 0.5725
set title 'arm hand' font ',13' offset 0,-0.5
set xrange [0.2:25]
set yrange [50:8e4]
set xtics (0.25,0.5,1,2,5,10,20)
set xlabel 'period [ms]'
set format y ''
unset ylabel
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
0.25 60000
0.5 37255.3
1 17379.9
2 8107.83
5 2841.75
10 1325.7
20 562.224
EOD
$d2 << EOD
0.25 60000
0.5 60000
1 33868.4
2 15799.9
5 5537.76
10 1764.5
20 179.142
EOD
$d3 << EOD
0.25 60000
0.5 60000
1 33868.4
2 15799.9
5 4160.6
10 1458.27
20 422.408
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.77
set rmargin at screen 0.985
set tmargin at screen 0.86
set bmargin at screen 0.5725
set title 'firm hand' font ',13' offset 0,-0.5
set xrange [0.2:25]
set yrange [50:8e4]
set xtics (0.25,0.5,1,2,5,10,20)
set xlabel 'period [ms]'
set format y ''
unset ylabel
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
0.25 60000
0.5 60000
1 25445.9
2 13057.7
5 4576.66
10 2348.55
20 1095.62
EOD
$d2 << EOD
0.25 60000
0.5 60000
1 37255.3
2 17379.9
5 5537.76
10 1764.5
20 47.1737
EOD
$d3 << EOD
0.25 60000
0.5 60000
1 37255.3
2 17379.9
5 5537.76
10 2348.55
20 1095.62
EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.065
set rmargin at screen 0.28
set tmargin at screen 0.4425
set bmargin at screen 0.155
set title 'push hand' font ',13' offset 0,-0.5
set xrange [450:45000]
set yrange [50:4000]
set xtics (500,2000,10000,30000)
set xlabel 'K [N/m]'
set format y '%g'
set ylabel 'to settle [ms]'
$d0 << EOD
500 395
604.941 422
731.907 442
885.522 468
1071.38 541
1296.24 608
1568.3 673
1897.45 808
2295.7 1019
2777.52 1418
3360.47 2879













EOD
$d1 << EOD
500 194
604.941 163
731.907 129
885.522 155
1071.38 150
1296.24 133
1568.3 168
1897.45 182
2295.7 180
2777.52 201
3360.47 255
4065.78 303
4919.11 362
5951.54 486
7200.66 698
8711.96 1677








EOD
$d2 << EOD
500 452
604.941 335
731.907 278
885.522 179
1071.38 140
1296.24 93
1568.3 63
1897.45 50
2295.7 50
2777.52 50
3360.47 50
4065.78 50
4919.11 52
5951.54 70
7200.66 98
8711.96 115
10540.4 147
12752.7 214
15429.2 312
18667.6 880




EOD
$d3 << EOD
500 392
604.941 339
731.907 349
885.522 316
1071.38 285
1296.24 261
1568.3 241
1897.45 222
2295.7 236
2777.52 230
3360.47 229
4065.78 224
4919.11 240
5951.54 241
7200.66 265
8711.96 286
10540.4 334
12752.7 388
15429.2 490
18667.6 1313




EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.3
set rmargin at screen 0.515
set tmargin at screen 0.4425
set bmargin at screen 0.155
set title 'light hand' font ',13' offset 0,-0.5
set xrange [450:45000]
set yrange [50:4000]
set xtics (500,2000,10000,30000)
set xlabel 'K [N/m]'
set format y ''
unset ylabel
$d0 << EOD
500 364
604.941 342
731.907 356
885.522 339
1071.38 371
1296.24 396
1568.3 419
1897.45 437
2295.7 500
2777.52 553
3360.47 634
4065.78 788
4919.11 1052
5951.54 2045










EOD
$d1 << EOD
500 196
604.941 169
731.907 135
885.522 157
1071.38 159
1296.24 146
1568.3 173
1897.45 165
2295.7 186
2777.52 201
3360.47 199
4065.78 254
4919.11 276
5951.54 325
7200.66 421
8711.96 522
10540.4 942







EOD
$d2 << EOD
500 407
604.941 322
731.907 228
885.522 193
1071.38 119
1296.24 103
1568.3 50
1897.45 50
2295.7 50
2777.52 50
3360.47 50
4065.78 50
4919.11 54
5951.54 71
7200.66 78
8711.96 106
10540.4 125
12752.7 152
15429.2 221
18667.6 342
22585.6 2551



EOD
$d3 << EOD
500 363
604.941 340
731.907 297
885.522 318
1071.38 298
1296.24 272
1568.3 249
1897.45 228
2295.7 242
2777.52 231
3360.47 220
4065.78 216
4919.11 232
5951.54 230
7200.66 244
8711.96 248
10540.4 263
12752.7 310
15429.2 332
18667.6 452




EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.535
set rmargin at screen 0.75
set tmargin at screen 0.4425
set bmargin at screen 0.155
set title 'arm hand' font ',13' offset 0,-0.5
set xrange [450:45000]
set yrange [50:4000]
set xtics (500,2000,10000,30000)
set xlabel 'K [N/m]'
set format y ''
unset ylabel
$d0 << EOD
500 377
604.941 433
731.907 389
885.522 434
1071.38 405
1296.24 446
1568.3 477
1897.45 503
2295.7 531
2777.52 550
3360.47 607
4065.78 670
4919.11 724
5951.54 853
7200.66 1043
8711.96 1533








EOD
$d1 << EOD
500 252
604.941 221
731.907 241
885.522 238
1071.38 220
1296.24 247
1568.3 247
1897.45 222
2295.7 262
2777.52 287
3360.47 271
4065.78 301
4919.11 331
5951.54 392
7200.66 448
8711.96 479
10540.4 656
12752.7 839
15429.2 1887





EOD
$d2 << EOD
500 366
604.941 280
731.907 187
885.522 137
1071.38 65
1296.24 50
1568.3 68
1897.45 77
2295.7 71
2777.52 65
3360.47 56
4065.78 84
4919.11 82
5951.54 109
7200.66 116
8711.96 147
10540.4 170
12752.7 183
15429.2 229
18667.6 317
22585.6 372
27325.9 520


EOD
$d3 << EOD
500 377
604.941 432
731.907 387
885.522 418
1071.38 398
1296.24 367
1568.3 329
1897.45 360
2295.7 338
2777.52 316
3360.47 296
4065.78 324
4919.11 312
5951.54 302
7200.66 329
8711.96 321
10540.4 341
12752.7 366
15429.2 392
18667.6 439
22585.6 486
27325.9 775


EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
set lmargin at screen 0.77
set rmargin at screen 0.985
set tmargin at screen 0.4425
set bmargin at screen 0.155
set title 'firm hand' font ',13' offset 0,-0.5
set xrange [450:45000]
set yrange [50:4000]
set xtics (500,2000,10000,30000)
set xlabel 'K [N/m]'
set format y ''
unset ylabel
$d0 << EOD
500 166
604.941 208
731.907 189
885.522 179
1071.38 166
1296.24 149
1568.3 184
1897.45 177
2295.7 163
2777.52 192
3360.47 178
4065.78 202
4919.11 190
5951.54 213
7200.66 224
8711.96 242
10540.4 263
12752.7 326
15429.2 416
18667.6 551




EOD
$d1 << EOD
500 159
604.941 148
731.907 124
885.522 111
1071.38 99
1296.24 116
1568.3 124
1897.45 121
2295.7 110
2777.52 128
3360.47 128
4065.78 119
4919.11 139
5951.54 135
7200.66 160
8711.96 173
10540.4 173
12752.7 238
15429.2 246
18667.6 302
22585.6 466



EOD
$d2 << EOD
500 246
604.941 212
731.907 164
885.522 132
1071.38 97
1296.24 62
1568.3 50
1897.45 50
2295.7 50
2777.52 50
3360.47 50
4065.78 50
4919.11 50
5951.54 54
7200.66 53
8711.96 55
10540.4 76
12752.7 81
15429.2 98
18667.6 118
22585.6 134
27325.9 191
33061.1 206

EOD
$d3 << EOD
500 166
604.941 208
731.907 189
885.522 179
1071.38 166
1296.24 149
1568.3 184
1897.45 177
2295.7 163
2777.52 179
3360.47 175
4065.78 165
4919.11 154
5951.54 169
7200.66 169
8711.96 159
10540.4 174
12752.7 169
15429.2 168
18667.6 202
22585.6 185
27325.9 219
33061.1 295

EOD
plot $d0 with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' notitle, $d1 with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' notitle, $d2 with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' notitle, $d3 with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' notitle
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
set tmargin at screen 0.06
set bmargin at screen 0
set key center top horizontal maxcols 4 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000' title 'fixed, c = 0', NaN with linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9' title 'fixed, c = 10 N s/m', NaN with linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73' title 'fixed, c = 50 N s/m', NaN with linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00' title 'adaptive from c = 0'
unset multiplot
