# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,900 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_late.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Clay that is felt late, and what helps' at screen 0.03,0.965 font ',16'
set label 2 'A ball of 1 mm, skin 1 mm, e 4: lines by simulation of clay as a height, full marks on real clay; the worst of four hands. P = A, but at least 5 and at most 50 ms.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set xrange [2.2:115]
set xtics ('0' 2.5,'5' 5,'10' 10,'20' 20,'50' 50,'100' 100)
set lmargin at screen 0.065
set rmargin at screen 0.331667
set tmargin at screen 0.86
set bmargin at screen 0.5825
set title 'Carving: swing of the handle' font ',13' offset 0,-0.5
set ylabel 'swing [mm]'
unset xlabel
set yrange [0.0008:10]
$d0 << EOD
2.2 0.18
115 0.18
EOD
$d1 << EOD
2.5 0.00260721
5 0.00163152
10 0.028165
20 0.0540246
50 1.22403
100 1.71993
EOD
$d2 << EOD
2.5 0.00240864
5 0.001
10 0.0225051
20 0.0272153
50 0.0540758
100 0.19545
EOD
$d3 << EOD
2.5 0.00135634
5 0.00306478
10 0.0425527
20 0.0234259
50 0.0489157
100 0.577108
EOD
$d4 << EOD
2.5 0.00135634
5 0.00306478
10 0.0425527
20 0.0234259
50 0.037338
100 0.035422
EOD
$d5 << EOD
2.5 0.010953
5 0.0112506
10 0.0113557
20 0.0113851
50 0.0113851
100 0.0113851
EOD
$d6 << EOD
5 0.0297766
20 0.250786
50 0.358862
100 0.672137
EOD
$d7 << EOD
5 0.0652858
20 0.0969134
50 0.229447
100 0.332898
EOD
$d8 << EOD
5 0.0652858
20 0.0969134
50 0.170261
100 0.117204
EOD
$d9 << EOD
5 0.00242081
20 0.0014379
50 0.001
100 0.0218253
EOD
plot $d0 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle, $d1 with lines dt 2 lw 1.8 lc rgb '#808080' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d3 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d4 with lines dt 1 lw 1.8 lc rgb '#cc79a7' notitle, $d5 with lines dt 1 lw 1.8 lc rgb '#009e73' notitle, $d6 with points pt 9 ps 1.1 lw 1.8 lc rgb '#808080' notitle, $d7 with points pt 11 ps 1.1 lw 1.8 lc rgb '#0072b2' notitle, $d8 with points pt 13 ps 1.1 lw 1.8 lc rgb '#cc79a7' notitle, $d9 with points pt 15 ps 1.1 lw 1.8 lc rgb '#009e73' notitle
unset label 1
unset label 2
set lmargin at screen 0.391667
set rmargin at screen 0.658333
set tmargin at screen 0.86
set bmargin at screen 0.5825
set title 'Carving: what is felt' font ',13' offset 0,-0.5
set ylabel 'mean force [N]'
unset xlabel
set yrange [0.04:10]
$d0 << EOD
2.5 0.125269
5 0.168677
10 0.287913
20 0.681988
50 2.23658
100 2.9015
EOD
$d1 << EOD
2.5 0.107643
5 0.142557
10 0.24816
20 0.670149
50 2.30523
100 2.88909
EOD
$d2 << EOD
2.5 0.124373
5 0.168403
10 0.300277
20 0.809431
50 2.4261
100 2.90072
EOD
$d3 << EOD
2.5 0.124373
5 0.168403
10 0.300277
20 0.809431
50 2.42711
100 2.79995
EOD
$d4 << EOD
2.5 0.0899807
5 0.0899807
10 0.0899807
20 0.0899807
50 0.0899807
100 0.0899807
EOD
$d5 << EOD
5 0.507335
20 1.14617
50 2.32458
100 2.87198
EOD
$d6 << EOD
5 0.504774
20 1.32508
50 2.47542
100 2.87874
EOD
$d7 << EOD
5 0.504774
20 1.32508
50 2.46224
100 2.71175
EOD
$d8 << EOD
5 0.257775
20 0.258496
50 0.258713
100 0.25855
EOD
plot $d0 with lines dt 2 lw 1.8 lc rgb '#808080' notitle, $d1 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d3 with lines dt 1 lw 1.8 lc rgb '#cc79a7' notitle, $d4 with lines dt 1 lw 1.8 lc rgb '#009e73' notitle, $d5 with points pt 9 ps 1.1 lw 1.8 lc rgb '#808080' notitle, $d6 with points pt 11 ps 1.1 lw 1.8 lc rgb '#0072b2' notitle, $d7 with points pt 13 ps 1.1 lw 1.8 lc rgb '#cc79a7' notitle, $d8 with points pt 15 ps 1.1 lw 1.8 lc rgb '#009e73' notitle
set lmargin at screen 0.718333
set rmargin at screen 0.985
set tmargin at screen 0.86
set bmargin at screen 0.5825
set title 'Carving: step at an exchange' font ',13' offset 0,-0.5
set ylabel 'step in one tick [N]'
unset xlabel
set yrange [0.0008:10]
$d0 << EOD
2.2 0.05
115 0.05
EOD
$d1 << EOD
2.5 0.0635923
5 0.0641953
10 0.117922
20 0.19589
50 0.420204
100 0.455086
EOD
$d2 << EOD
2.5 0.338446
5 0.394512
10 0.693376
20 1.16834
50 1.665
100 1.12427
EOD
$d3 << EOD
2.5 0.085305
5 0.0880548
10 0.145085
20 0.260449
50 0.353135
100 0.284181
EOD
$d4 << EOD
2.5 0.085305
5 0.0880548
10 0.145085
20 0.260449
50 0.353135
100 0.263818
EOD
$d5 << EOD
2.5 0.001
5 0.001
10 0.001
20 0.001
50 0.001
100 0.001
EOD
$d6 << EOD
5 0.118941
20 0.179499
50 0.279251
100 0.360818
EOD
$d7 << EOD
5 0.144587
20 0.260179
50 0.289583
100 0.204414
EOD
$d8 << EOD
5 0.144587
20 0.260179
50 0.294445
100 0.234445
EOD
$d9 << EOD
5 0.001
20 0.001
50 0.0326871
100 0.1221
EOD
plot $d0 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle, $d1 with lines dt 2 lw 1.8 lc rgb '#808080' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d3 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d4 with lines dt 1 lw 1.8 lc rgb '#cc79a7' notitle, $d5 with lines dt 1 lw 1.8 lc rgb '#009e73' notitle, $d6 with points pt 9 ps 1.1 lw 1.8 lc rgb '#808080' notitle, $d7 with points pt 11 ps 1.1 lw 1.8 lc rgb '#0072b2' notitle, $d8 with points pt 13 ps 1.1 lw 1.8 lc rgb '#cc79a7' notitle, $d9 with points pt 15 ps 1.1 lw 1.8 lc rgb '#009e73' notitle
set lmargin at screen 0.065
set rmargin at screen 0.331667
set tmargin at screen 0.4675
set bmargin at screen 0.19
set title 'Adding around a tool that rests' font ',13' offset 0,-0.5
set ylabel 'energy given [mJ]'
set xlabel 'age A [ms]'
set yrange [0.008:1000]
$d0 << EOD
2.2 2
115 2
EOD
$d1 << EOD
2.5 42.8028
5 36.9493
10 31.3971
20 28.4929
50 21.0425
100 14.0629
EOD
$d2 << EOD
2.5 40.1626
5 34.4977
10 30.5098
20 28.1677
50 20.3834
100 13.7882
EOD
$d3 << EOD
2.5 2.26345
5 2.24854
10 2.216
20 2.16709
50 2.04658
100 1.84451
EOD
$d4 << EOD
5 15.2007
20 13.007
50 5.99961
100 3.42707
EOD
$d5 << EOD
5 1.76015
20 1.90729
50 2.01898
100 2.45274
EOD
plot $d0 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle, $d1 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#e69f00' notitle, $d3 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d4 with points pt 5 ps 1.1 lw 1.8 lc rgb '#e69f00' notitle, $d5 with points pt 11 ps 1.1 lw 1.8 lc rgb '#0072b2' notitle
set lmargin at screen 0.391667
set rmargin at screen 0.658333
set tmargin at screen 0.4675
set bmargin at screen 0.19
set title 'Smoothing in a hollow' font ',13' offset 0,-0.5
set ylabel 'energy given [mJ]'
set xlabel 'age A [ms]'
set yrange [0.008:1000]
$d0 << EOD
2.2 2
115 2
EOD
$d1 << EOD
2.5 1.2136
5 1.14037
10 0.990822
20 0.73874
50 0.828867
100 0.92321
EOD
$d2 << EOD
2.5 1.18224
5 1.10268
10 0.953361
20 0.739584
50 0.830671
100 0.928337
EOD
$d3 << EOD
2.5 1.18224
5 1.10268
10 0.953361
20 0.740438
50 0.738663
100 0.795416
EOD
$d4 << EOD
5 0.290531
20 0.280226
50 0.269529
100 0.269487
EOD
$d5 << EOD
5 0.290531
20 0.280226
50 0.269529
100 0.269487
EOD
plot $d0 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle, $d1 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#e69f00' notitle, $d3 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d4 with points pt 5 ps 1.1 lw 1.8 lc rgb '#e69f00' notitle, $d5 with points pt 11 ps 1.1 lw 1.8 lc rgb '#0072b2' notitle
set lmargin at screen 0.718333
set rmargin at screen 0.985
set tmargin at screen 0.4675
set bmargin at screen 0.19
set title 'Sliding at 50 mm/s for 2 s' font ',13' offset 0,-0.5
set ylabel 'without a window [ms]'
set xlabel 'age A [ms]'
set yrange [0.8:2000]
$d0 << EOD
2.5 1
5 1
10 1
20 1
50 615
100 1766
EOD
$d1 << EOD
2.5 1
5 1
10 1
20 1
50 385
100 1731
EOD
$d2 << EOD
2.5 1
5 1
10 1
20 1
50 6
100 49
EOD
$d3 << EOD
5 1
20 1
50 8
100 905
EOD
plot $d0 with lines dt 1 lw 1.8 lc rgb '#000000' notitle, $d1 with lines dt 1 lw 1.8 lc rgb '#0072b2' notitle, $d2 with lines dt 1 lw 1.8 lc rgb '#009e73' notitle, $d3 with points pt 15 ps 1.1 lw 1.8 lc rgb '#009e73' notitle
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
set tmargin at screen 0.11
set bmargin at screen 0
set key center top horizontal maxcols 4 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with lines dt 2 lw 1.8 lc rgb '#808080' title 'blended, no coupling', NaN with lines dt 1 lw 1.8 lc rgb '#000000' title 'at once', NaN with lines dt 1 lw 1.8 lc rgb '#e69f00' title 'blended over 5 ms', NaN with lines dt 1 lw 1.8 lc rgb '#0072b2' title 'blended, account', NaN with lines dt 1 lw 1.8 lc rgb '#cc79a7' title 'and a softer coupling', NaN with lines dt 1 lw 1.8 lc rgb '#009e73' title 'or own cuts stamped', NaN with lines dt 1 lw 1.8 lc rgb '#009e73' title 'and windows that reach as far', NaN with lines lw 1.5 dt 2 lc rgb '#b00000' title 'limit cycle; aim'
unset multiplot
