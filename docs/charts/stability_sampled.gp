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
set bmargin at screen 0.57
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
5846.83 3.72288
1497.66 0.001
374.963 0.001
4900.83 3.023
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
9611.09 3.83546
2986.09 0.001
749.781 0.001
5913.78 3.47996
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
9611.09 2.38553
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
set bmargin at screen 0.57
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
0.44 1.38322
0.88 1.2127
1.76 1.02855
14.08 0.232261
0.44 1.40376
0.88 1.22654
1.76 1.02525
14.08 0.228683
0.44 1.37767
0.88 1.23107
1.76 0.578765
14.08 0.244021
0.44 1.39315
0.88 1.22949
1.76 0.535007
14.08 0.114295
EOD
$d2 << EOD
0.5 0.453852
0.5 0.516854
0.5 0.552172
1 0.261284
1 0.390689
1 0.409614
2 0.124369
2 0.175559
2 0.316869
16 0.0742272
16 0.0541299
16 0.11279
0.5 0.442493
0.5 0.499641
0.5 0.522513
1 0.241458
1 0.367263
1 0.411085
2 0.107322
2 0.251831
2 0.32374
16 0.06399
16 0.0789646
16 0.178265
0.5 0.432906
0.5 0.505302
0.5 0.535309
1 0.284489
1 0.371719
1 0.415431
2 0.103751
2 0.273182
2 0.324636
16 0.0636451
16 0.0517588
16 0.161279
0.5 0.433424
0.5 0.5136
0.5 0.530284
1 0.19162
1 0.366574
1 0.403032
2 0.155307
2 0.165482
2 0.287566
16 0.0808421
16 0.0588778
16 0.153778
0.5 0.437621
0.5 0.511467
0.5 0.529662
1 0.146978
1 0.370366
1 0.40818
2 0.0599444
2 0.146953
2 0.17705
16 0.0368826
16 0.0305307
16 0.14064
EOD
$d3 << EOD
0.57 0.0867114
0.57 0.086437
1.14 0.0820788
1.14 0.0832082
2.28 0.0806287
2.28 0.0612124
18.24 0.0565321
18.24 0.0973324
0.57 0.0975377
0.57 0.211763
1.14 0.0801342
1.14 0.123868
2.28 0.0539144
2.28 0.0619238
18.24 0.0518284
18.24 0.082786
0.57 0.0871795
0.57 0.206655
1.14 0.0962185
1.14 0.0980182
2.28 0.0751975
2.28 0.0857319
18.24 0.0843424
18.24 0.090056
0.57 0.0938238
0.57 0.105142
1.14 0.0677203
1.14 0.0930389
2.28 0.0483386
2.28 0.0691052
18.24 0.0427828
18.24 0.096681
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#606060' title 'buzz', $d1 with points pt 4 ps 0.9 lw 1.6 lc rgb '#cc79a7' title 'direct, raw velocities', $d2 with points pt 6 ps 0.9 lw 1.6 lc rgb '#000000' title 'direct, mean of 3 ms', $d3 with points pt 3 ps 0.9 lw 1.6 lc rgb '#d55e00' title 'default servo'
set lmargin at screen 0.07
set rmargin at screen 0.4825
set tmargin at screen 0.41
set bmargin at screen 0.13
set title 'Slope at the first limit cycle, direct' font ',13' offset 0,-0.5
set key Left reverse samplen 1.6 font ',11' opaque right top
unset logscale x
set yrange [1000:60000]
set xlabel 'radius of the tool, exponent, hand' offset 0,-1.4
set ylabel 'slope where it rests [N/m]'
set xtics ("0.5 mm\ne 2\npush" 1,"0.5 mm\ne 2\nlight" 2,"1 mm\ne 2\npush" 3,"0.5 mm\ne 4\npush" 4,"0.5 mm\ne 4\nlight" 5,"1 mm\ne 4\npush" 6)
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
set tmargin at screen 0.41
set bmargin at screen 0.13
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
0.25 0.0460411
0.5 0.0477954
1 0.048585
4 0.0353193
EOD
$d3 << EOD
0.25 0.0135379
0.5 0.0177701
1 0.0269011
4 0.0334262
EOD
$d4 << EOD
0.25 0.009869
0.5 0.0106836
1 0.0103681
4 0.00979767
EOD
$d5 << EOD
0.25 0.00777055
0.5 0.00800043
1 0.00911283
4 0.0108274
EOD
plot $d0 with lines lw 1.4 dt 2 lc rgb '#606060' title 'theory C.4, smooth, 8 nodes', $d1 with lines lw 1.4 dt 3 lc rgb '#606060' title 'theory C.4, smooth, 16 nodes', $d2 with linespoints pt 5 ps 0.9 lw 1.6 lc rgb '#d55e00' title 'leaning 20 degrees, e 4, skin 1 mm', $d3 with linespoints pt 7 ps 0.9 lw 1.6 lc rgb '#e69f00' title 'leaning, e 2, skin 8 mm', $d4 with linespoints pt 9 ps 0.9 lw 1.6 lc rgb '#0072b2' title 'along the cells, e 4, skin 1 mm', $d5 with linespoints pt 13 ps 0.9 lw 1.6 lc rgb '#56b4e9' title 'along the cells, e 2, skin 8 mm'
unset multiplot
