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
71.0695 23.6324
EOD
$d1 << EOD
297.099 0.2389
153.608 0.598957
101.627 1.20058
83.5487 2.39249
82.7542 4.7896
87.1662 9.31272
EOD
$d2 << EOD
389.958 0.00248189
265.136 0.0155409
134.858 0.0619464
125.646 0.247187
117.984 0.977812
115.142 3.6898
EOD
$d3 << EOD
165.413 0.0894321
166.888 0.000812632
168.649 9.05579e-06
170.99 1.46189e-06
170.491 0.000145967
171.131 0.0145967
138.088 0.145963
142.914 1.45861
147.084 5.78907
EOD
$d4 << EOD
188.245 0.11209
187.103 0.00127809
184.123 1.29611e-05
182.878 8.79376e-08
184.07 1.35197e-06
185.25 0.000135197
190.282 0.0135187
197.427 0.216053
EOD
$d5 << EOD
208.368 0.0760507
EOD
$d6 << EOD
114.719 1e-09
114.719 100
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
70.3729 23.6324
EOD
$d1 << EOD
113.939 2.46366
196.755 0.357462
272.929 0.0619722
346.278 0.0115417
418.171 0.00224634
EOD
$d2 << EOD
250.482 2.47802
159.484 2.53968
90.422 2.74815
79.7285 3.45832
77.9942 5.47124
76.9911 9.77699
EOD
$d3 << EOD
347.978 2.46384
192.694 2.46478
115.551 2.46866
106.163 2.49243
103.835 2.70544
103.458 4.52479
EOD
$d4 << EOD
139.047 2.46512
138.848 2.46365
138.481 2.46366
139.236 2.46366
137.438 2.46366
172.449 2.46369
174.564 2.46811
177.088 2.88319
183.385 6.43322
EOD
$d5 << EOD
247.191 2.46888
249.33 2.46366
244.455 2.46366
249.525 2.46366
251.429 2.46366
249.522 2.46366
251.698 2.46367
257.434 2.46438
261.412 2.48383
EOD
$d6 << EOD
211.001 0.0855339
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
70.3729 0.307984
EOD
$d1 << EOD
113.939 0.0187474
196.755 0.000305425
272.929 9.2963e-06
346.278 3.3366e-07
418.171 1.31927e-08
EOD
$d2 << EOD
250.482 0.0189516
159.484 0.0198175
90.422 0.0226548
79.7285 0.031417
77.9942 0.0531841
76.9911 0.0973655
EOD
$d3 << EOD
347.978 0.0187534
192.694 0.0187878
115.551 0.0189544
106.163 0.0202362
103.835 0.0313696
103.458 0.0876392
EOD
$d4 << EOD
139.047 0.0188644
138.848 0.0187471
138.481 0.0187474
139.236 0.0187474
137.438 0.0187474
172.449 0.0187481
174.564 0.0188425
177.088 0.0267459
183.385 0.0775057
EOD
$d5 << EOD
247.191 0.0190408
249.33 0.0187477
244.455 0.0187474
249.525 0.0187474
251.429 0.0187474
249.522 0.0187474
251.698 0.0187477
257.434 0.0187804
261.412 0.0199567
EOD
$d6 << EOD
211.001 0.00151626
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
