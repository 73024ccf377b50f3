# Made by 'argil chart surface'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,900 font 'DejaVu Sans,12' background rgb 'white'
set output 'surface.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'The surface: error of its vertices against time' at screen 0.03,0.965 font ',16'
set label 2 'Whole extraction, normals and welding included (OpenVDB makes no normals; of Blender the operator alone); R/h = 16 to 256; CPU time of all threads.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set lmargin at screen 0.075
set rmargin at screen 0.328333
set tmargin at screen 0.87
set bmargin at screen 0.6
set title 'ball: error against time' font ',13' offset 0,-0.5
set logscale xy
set xrange [*:*]
set yrange [*:*]
set xtics 100
set format x '%g'
set format y '%.0e'
set xlabel 'CPU time [ms]'
set ylabel 'greatest error / R_curv'
$d0 << EOD
1.19536 7.16369e-06
8.12879 8.98725e-07
22.4545 1.1017e-07
101.412 1.37639e-08
445.592 1.72471e-09
EOD
$d1 << EOD
2.71199 0.00144541
11.5498 0.000359525
30.7251 9.03168e-05
114.215 2.26185e-05
427.546 5.68721e-06
EOD
$d2 << EOD
80.9008 0.00125564
328.844 0.000313541
1169.09 7.85702e-05
4575.55 1.96898e-05
18820.7 4.96962e-06
EOD
$d3 << EOD
0.512483 6.07013e-05
1.25871 3.88255e-05
1.23024 7.35753e-06
4.60295 7.12994e-06
5.10666 8.95572e-07
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle
unset label 1
unset label 2
set lmargin at screen 0.403333
set rmargin at screen 0.656667
set tmargin at screen 0.87
set bmargin at screen 0.6
set title 'ball: error in h²/R_curv' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set ylabel 'error [h²/R_curv]'
$d0 << EOD
16 0.0018339
32 0.000920294
64 0.000451256
128 0.000225507
256 0.000113031
EOD
$d1 << EOD
16 0.370025
32 0.368153
64 0.369937
128 0.370581
256 0.372717
EOD
$d2 << EOD
16 0.321443
32 0.321066
64 0.321824
128 0.322597
256 0.325689
EOD
$d3 << EOD
16 0.0155395
32 0.0397573
64 0.0301365
128 0.116817
256 0.0586922
EOD
$d4 << EOD
16 0.000362271
32 0.000171686
64 8.46258e-05
128 4.20708e-05
256 2.11822e-05
EOD
$d5 << EOD
16 0.242011
32 0.241958
64 0.241989
128 0.242
256 0.242023
EOD
$d6 << EOD
16 0.187464
32 0.18896
64 0.189527
128 0.189765
256 0.189925
EOD
$d7 << EOD
16 0.000264006
32 6.79801e-05
64 1.71338e-05
128 6.43226e-06
256 8.08602e-06
EOD
$d8 << EOD
16 0.5
32 0.5
64 0.5
128 0.5
256 0.5
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d4 with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' notitle, $d5 with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' notitle, $d6 with linespoints pt 10 ps 0.6 lw 1.2 dt 2 lc rgb '#cc79a7' notitle, $d7 with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.731667
set rmargin at screen 0.985
set tmargin at screen 0.87
set bmargin at screen 0.6
set title 'ball: cost of a vertex' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set yrange [0.05:100]
set ylabel 'CPU time [µs / vertex]'
$d0 << EOD
16 0.236424
32 0.402316
64 0.277916
128 0.313749
256 0.344682
EOD
$d1 << EOD
16 0.561488
32 0.598126
64 0.397911
128 0.369791
256 0.346085
EOD
$d2 << EOD
16 16.1737
32 16.7249
64 15.0033
128 14.7476
256 15.2001
EOD
$d3 << EOD
16 0.408679
32 0.2493
64 0.244727
128 0.227835
256 0.252643
EOD
$d4 << EOD
16 0.6
32 0.6
64 0.6
128 0.6
256 0.6
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d4 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.075
set rmargin at screen 0.328333
set tmargin at screen 0.475
set bmargin at screen 0.205
set title 'torus: error against time' font ',13' offset 0,-0.5
set logscale xy
set xrange [*:*]
set yrange [*:*]
set xtics 100
set format x '%g'
set format y '%.0e'
set xlabel 'CPU time [ms]'
set ylabel 'greatest error / R_curv'
$d0 << EOD
1.44648 0.00010241
7.02155 1.13097e-05
28.913 1.41228e-06
118.932 1.8092e-07
568.596 2.17428e-08
EOD
$d1 << EOD
2.56819 0.00666409
9.93812 0.00177346
37.424 0.000429582
141.779 0.0001101
561.994 2.77982e-05
EOD
$d2 << EOD
101.792 0.00759141
371.944 0.00191974
1470.27 0.000487633
6011.04 0.000122175
25178.9 3.07087e-05
EOD
$d3 << EOD
3.03537 0.0117818
2.04934 0.00614914
7.23421 0.00423002
7.55812 0.00237343
21.4817 0.00118937
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle
set lmargin at screen 0.403333
set rmargin at screen 0.656667
set tmargin at screen 0.475
set bmargin at screen 0.205
set title 'torus: error in h²/R_curv' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set ylabel 'error [h²/R_curv]'
$d0 << EOD
16 0.00419473
32 0.00185299
64 0.00092555
128 0.00047427
256 0.00022799
EOD
$d1 << EOD
16 0.272961
32 0.290564
64 0.281531
128 0.28862
256 0.291485
EOD
$d2 << EOD
16 0.310944
32 0.314529
64 0.319575
128 0.320276
256 0.322004
EOD
$d3 << EOD
16 0.482581
32 1.00748
64 2.77219
128 6.22181
256 12.4715
EOD
$d4 << EOD
16 0.00074854
32 0.000275484
64 0.00012229
128 5.9186e-05
256 2.92436e-05
EOD
$d5 << EOD
16 0.126898
32 0.126982
64 0.126931
128 0.126938
256 0.126929
EOD
$d6 << EOD
16 0.109654
32 0.109951
64 0.110411
128 0.110646
256 0.110677
EOD
$d7 << EOD
16 0.00135976
32 0.000390993
64 0.000103924
128 2.65034e-05
256 7.39505e-06
EOD
$d8 << EOD
16 0.5
32 0.5
64 0.5
128 0.5
256 0.5
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d4 with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' notitle, $d5 with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' notitle, $d6 with linespoints pt 10 ps 0.6 lw 1.2 dt 2 lc rgb '#cc79a7' notitle, $d7 with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' notitle, $d8 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.731667
set rmargin at screen 0.985
set tmargin at screen 0.475
set bmargin at screen 0.205
set title 'torus: cost of a vertex' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set yrange [0.05:100]
set ylabel 'CPU time [µs / vertex]'
$d0 << EOD
16 0.220199
32 0.267233
64 0.274835
128 0.282686
256 0.33786
EOD
$d1 << EOD
16 0.41476
32 0.402255
64 0.378609
128 0.358503
256 0.355288
EOD
$d2 << EOD
16 15.7866
32 14.7002
64 14.6947
128 15.1132
256 15.8708
EOD
$d3 << EOD
16 0.590539
32 0.313355
64 0.435796
128 0.291033
256 0.397979
EOD
$d4 << EOD
16 0.6
32 0.6
64 0.6
128 0.6
256 0.6
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' notitle, $d3 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d4 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
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
set key center top horizontal maxcols 3 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' title 'Argil, finest voxels everywhere', NaN with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' title 'OpenVDB volumeToMesh', NaN with linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7' title 'Blender voxel remesh', NaN with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' title 'Argil, the clay as it is kept', NaN with lines lw 1.5 dt 2 lc rgb '#b00000' title 'asked: 0.5 h²/R, 0.6 µs', NaN with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' title 'Argil, rms', NaN with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' title 'OpenVDB, rms', NaN with linespoints pt 10 ps 0.6 lw 1.2 dt 2 lc rgb '#cc79a7' title 'Blender, rms', NaN with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' title 'Argil, greatest on edges'
unset multiplot
