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
set format x '%g'
set format y '%g'
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
70.7176 23.6324
EOD
$d1 << EOD
269.717 0.2389
151.483 0.598957
97.5675 1.20058
79.6859 2.39249
78.0759 4.7896
77.6433 9.31272
EOD
$d2 << EOD
327.308 0.00248189
177.215 0.0155409
130.481 0.0619464
108.975 0.247187
112.508 0.977812
104.686 3.6898
EOD
$d3 << EOD
142.058 0.0894321
140.008 0.000812632
139.099 9.05579e-06
140.648 1.46189e-06
137.146 0.000145967
138.204 0.0145967
138.618 0.145963
141.848 1.45861
147.147 5.78907
EOD
$d4 << EOD
182.329 0.11209
187.322 0.00127809
188.472 1.29611e-05
187.833 8.79376e-08
189 1.35197e-06
190.986 0.000135197
191.776 0.0135187
199.755 0.216053
EOD
$d5 << EOD
190.937 0.0760507
EOD
$d6 << EOD
115.552 1e-09
115.552 100
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with points pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d2 with points pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d3 with points pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d4 with points pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d5 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle, $d6 with lines lw 2 dt 2 lc rgb '#0072b2' notitle
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
set yrange [1e-3:100]
set ytics 1e-3,10
set ylabel 'normal off by [degrees rms]'
$d0 << EOD
70.7191 23.6324
EOD
$d1 << EOD
114.379 2.46366
199.168 0.357462
272.61 0.0619722
347.484 0.0115417
420.63 0.00224634
EOD
$d2 << EOD
304.491 2.47802
158.741 2.53968
91.5772 2.74815
81.3982 3.45832
78.7304 5.47124
76.5521 9.77699
EOD
$d3 << EOD
312.192 2.46384
180.565 2.46478
123.44 2.46866
104.748 2.49243
110.354 2.70544
102.717 4.52479
EOD
$d4 << EOD
139.773 2.46512
139.913 2.46365
140.031 2.46366
138.575 2.46366
137.9 2.46366
137.143 2.46369
138.304 2.46811
142.6 2.88319
147.477 6.43322
EOD
$d5 << EOD
183.856 2.46888
186.845 2.46366
188.322 2.46366
186.146 2.46366
184.42 2.46366
188.789 2.46366
187.541 2.46367
192.157 2.46438
199.632 2.48383
EOD
$d6 << EOD
192.891 0.0855339
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d2 with points pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d3 with points pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d4 with points pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d5 with points pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d6 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle
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
set yrange [1e-9:1]
set ytics 1e-9,10
set ylabel 'distance off by [mm rms]'
$d0 << EOD
70.7191 0.307984
EOD
$d1 << EOD
114.379 0.0187474
199.168 0.000305425
272.61 9.2963e-06
347.484 3.3366e-07
420.63 1.31927e-08
EOD
$d2 << EOD
304.491 0.0189516
158.741 0.0198175
91.5772 0.0226548
81.3982 0.031417
78.7304 0.0531841
76.5521 0.0973655
EOD
$d3 << EOD
312.192 0.0187534
180.565 0.0187878
123.44 0.0189544
104.748 0.0202362
110.354 0.0313696
102.717 0.0876392
EOD
$d4 << EOD
139.773 0.0188644
139.913 0.0187471
140.031 0.0187474
138.575 0.0187474
137.9 0.0187474
137.143 0.0187481
138.304 0.0188425
142.6 0.0267459
147.477 0.0775057
EOD
$d5 << EOD
183.856 0.0190408
186.845 0.0187477
188.322 0.0187474
186.146 0.0187474
184.42 0.0187474
188.789 0.0187474
187.541 0.0187477
192.157 0.0187804
199.632 0.0199567
EOD
$d6 << EOD
192.891 0.00151626
EOD
plot $d0 with points pt 2 ps 1.2 lw 2 lc rgb '#606060' notitle, $d1 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' notitle, $d2 with points pt 4 ps 1 lw 2 lc rgb '#e69f00' notitle, $d3 with points pt 5 ps 0.9 lw 2 lc rgb '#d55e00' notitle, $d4 with points pt 8 ps 1 lw 2 lc rgb '#56b4e9' notitle, $d5 with points pt 9 ps 1 lw 2 lc rgb '#009e73' notitle, $d6 with points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7' notitle
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
