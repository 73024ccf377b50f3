# Made by 'argil chart normals'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,980 font 'DejaVu Sans,12' background rgb 'white'
set output 'normals.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Normals of waves: what each way costs and misses' at screen 0.03,0.965 font ',16'
set label 2 'Waves of 50 mm, 5 mm high (3.16). Distance and normal of random points, each answer after the last; on the surface, and 3 mm below it, where the nearest point is not straight above.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set lmargin at screen 0.075
set rmargin at screen 0.49
set tmargin at screen 0.87
set bmargin at screen 0.575
set title 'On the surface, by spacing or step' font ',13' offset 0,-0.5
set logscale xy
set xrange [5e-13:20]
set yrange [1e-9:100]
set format x '%.0e'
set format y '%.0e'
set xtics 1e-12,100
set ytics 1e-8,100
set xlabel 'spacing, step [mm]'
set ylabel 'normal off by [degrees rms]'
$d0 << EOD
0.2 0.2389
0.5 0.598957
1 1.20058
2 2.39249
4 4.7896
8 9.31272
EOD
$d1 << EOD
0.2 0.00248189
0.5 0.0155409
1 0.0619464
2 0.247187
4 0.977812
8 3.6898
EOD
$d2 << EOD
1e-12 0.0894321
1e-10 0.000812632
1e-08 9.05579e-06
1e-06 1.46189e-06
0.0001 0.000145967
0.01 0.0145967
0.1 0.145963
1 1.45861
4 5.78907
EOD
$d3 << EOD
1e-12 0.11209
1e-10 0.00127809
1e-08 1.29611e-05
1e-06 8.79376e-08
0.01 1.35197e-06
0.1 0.000135197
1 0.0135187
4 0.216053
EOD
$d4 << EOD
1e-12 0.0760507
10 0.0760507
EOD
plot $d0 with linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d1 with linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d2 with linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d3 with linespoints pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d4 with lines lw 2 dt 2 lc rgb '#cc79a7' notitle
unset label 1
unset label 2
set lmargin at screen 0.565
set rmargin at screen 0.98
set tmargin at screen 0.87
set bmargin at screen 0.575
set title 'On the surface, by time; the dashed line is exact' font ',13' offset 0,-0.5
set logscale xy
set xrange [40:1000]
set xtics (50,100,200,300,500,1000)
set format x '%g'
set xlabel 'thread CPU time [ns]'
set yrange [1e-9:100]
set ylabel 'normal off by [degrees rms]'
$d0 << EOD
71.1827 23.6324
EOD
$d1 << EOD
255.622 0.2389
172.921 0.598957
96.5002 1.20058
75.8713 2.39249
74.785 4.7896
72.4403 9.31272
EOD
$d2 << EOD
351.365 0.00248189
266.919 0.0155409
141.093 0.0619464
103.943 0.247187
92.4739 0.977812
89.4332 3.6898
EOD
$d3 << EOD
176.932 0.0894321
145.862 0.000812632
147.094 9.05579e-06
148.368 1.46189e-06
150.268 0.000145967
150.744 0.0145967
147.141 0.145963
156.018 1.45861
166.835 5.78907
EOD
$d4 << EOD
176.506 0.11209
236.438 0.00127809
246.776 1.29611e-05
244.739 8.79376e-08
249.759 1.35197e-06
243.709 0.000135197
246.986 0.0135187
196.823 0.216053
EOD
$d5 << EOD
200.843 0.0760507
EOD
$d6 << EOD
121.625 1e-09
121.625 100
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d3 with linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d4 with linespoints pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d5 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle, $d6 with lines lw 2 dt 2 lc rgb '#0072b2' notitle
set lmargin at screen 0.075
set rmargin at screen 0.49
set tmargin at screen 0.455
set bmargin at screen 0.16
set title '3 mm below the surface' font ',13' offset 0,-0.5
set logscale xy
set xrange [40:1000]
set xtics (50,100,200,300,500,1000)
set format x '%g'
set xlabel 'thread CPU time [ns]'
set yrange [*:100]
set format y '%g'
set ytics autofreq
set ylabel 'normal off by [degrees rms]'
$d0 << EOD
70.7168 23.6324
EOD
$d1 << EOD
121.615 2.46366
280.02 0.357462
402.585 0.0619722
408.188 0.0115417
543.949 0.00224634
EOD
$d2 << EOD
295.311 2.47802
222.312 2.53968
139.852 2.74815
86.7071 3.45832
98.5127 5.47124
96.5663 9.77699
EOD
$d3 << EOD
376.443 2.46384
199.925 2.46478
112.731 2.46866
106.032 2.49243
100.876 2.70544
107.419 4.52479
EOD
$d4 << EOD
181.84 2.46512
149.149 2.46365
152.502 2.46366
149.934 2.46366
148.766 2.46366
149.91 2.46369
148.71 2.46811
154.286 2.88319
174.3 6.43322
EOD
$d5 << EOD
189.616 2.46888
176.604 2.46366
248.48 2.46366
248.985 2.46366
246.251 2.46366
248.473 2.46366
242.725 2.46367
178.542 2.46438
191.877 2.48383
EOD
$d6 << EOD
200.482 0.0855339
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d2 with linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d3 with linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d4 with linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d5 with linespoints pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d6 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle
set lmargin at screen 0.565
set rmargin at screen 0.98
set tmargin at screen 0.455
set bmargin at screen 0.16
set title '3 mm below the surface: the distance' font ',13' offset 0,-0.5
set logscale xy
set xrange [40:1000]
set xtics (50,100,200,300,500,1000)
set format x '%g'
set xlabel 'thread CPU time [ns]'
set yrange [*:*]
set ylabel 'distance off by [mm rms]'
$d0 << EOD
70.7168 0.307984
EOD
$d1 << EOD
121.615 0.0187474
280.02 0.000305425
402.585 9.2963e-06
408.188 3.3366e-07
543.949 1.31927e-08
EOD
$d2 << EOD
295.311 0.0189516
222.312 0.0198175
139.852 0.0226548
86.7071 0.031417
98.5127 0.0531841
96.5663 0.0973655
EOD
$d3 << EOD
376.443 0.0187534
199.925 0.0187878
112.731 0.0189544
106.032 0.0202362
100.876 0.0313696
107.419 0.0876392
EOD
$d4 << EOD
181.84 0.0188644
149.149 0.0187471
152.502 0.0187474
149.934 0.0187474
148.766 0.0187474
149.91 0.0187481
148.71 0.0188425
154.286 0.0267459
174.3 0.0775057
EOD
$d5 << EOD
189.616 0.0190408
176.604 0.0187477
248.48 0.0187474
248.985 0.0187474
246.251 0.0187474
248.473 0.0187474
242.725 0.0187477
178.542 0.0187804
191.877 0.0199567
EOD
$d6 << EOD
200.482 0.00151626
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d2 with linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d3 with linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d4 with linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d5 with linespoints pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d6 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle
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
set tmargin at screen 0.1
set bmargin at screen 0
set key center top horizontal maxcols 4 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with points pt 2 ps 1.2 lw 2 lc rgb '#606060' title 'straight up (3.17)', NaN with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'analytic (3.22), 0 to 4 steps', NaN with linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00' title 'table, nearest', NaN with linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00' title 'table, bilinear', NaN with linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9' title 'differences ahead', NaN with linespoints pt 9 ps 1 lw 2 lc rgb '#009e73' title 'central differences', NaN with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' title 'network of sines'
unset multiplot
