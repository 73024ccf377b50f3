# Made by 'argil chart surface'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'surface.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'The surface: error of its vertices against time' at screen 0.03,0.965 font ',16'
set label 2 'Whole extraction, normals and welding included (OpenVDB makes no normals); R/h = 16 to 256; CPU time of all threads.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set lmargin at screen 0.075
set rmargin at screen 0.328333
set tmargin at screen 0.865
set bmargin at screen 0.5925
set title 'ball: error against time' font ',13' offset 0,-0.5
set logscale xy
set xrange [*:*]
set yrange [*:*]
set xtics auto
set format x '%g'
set format y '%.0e'
set xlabel 'CPU time [ms]'
set ylabel 'greatest error / R_curv'
$d0 << EOD
2.80172 7.16369e-06
9.82014 8.98725e-07
44.3602 1.1017e-07
178.046 1.37639e-08
792.213 1.72471e-09
EOD
$d1 << EOD
7.27369 0.00144541
16.4613 0.000359525
51.646 9.03168e-05
208.5 2.26185e-05
792.394 5.68721e-06
EOD
$d2 << EOD
0.859362 6.07013e-05
2.6366 3.88255e-05
2.12558 7.35753e-06
10.1878 7.12994e-06
10.7158 8.95572e-07
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle
unset label 1
unset label 2
set lmargin at screen 0.403333
set rmargin at screen 0.656667
set tmargin at screen 0.865
set bmargin at screen 0.5925
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
16 0.0155395
32 0.0397573
64 0.0301365
128 0.116817
256 0.0586922
EOD
$d3 << EOD
16 0.000362271
32 0.000171686
64 8.46258e-05
128 4.20708e-05
256 2.11822e-05
EOD
$d4 << EOD
16 0.242011
32 0.241958
64 0.241989
128 0.242
256 0.242023
EOD
$d5 << EOD
16 0.000264006
32 6.79801e-05
64 1.71338e-05
128 6.43226e-06
256 8.08602e-06
EOD
$d6 << EOD
16 0.5
32 0.5
64 0.5
128 0.5
256 0.5
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' notitle, $d4 with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' notitle, $d5 with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' notitle, $d6 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.731667
set rmargin at screen 0.985
set tmargin at screen 0.865
set bmargin at screen 0.5925
set title 'ball: cost of a vertex' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set yrange [0.05:10]
set ylabel 'CPU time [µs / vertex]'
$d0 << EOD
16 0.554138
32 0.486025
64 0.54904
128 0.55084
256 0.612806
EOD
$d1 << EOD
16 1.50594
32 0.852473
64 0.668851
128 0.675055
256 0.641418
EOD
$d2 << EOD
16 0.685297
32 0.522203
64 0.422832
128 0.504272
256 0.530146
EOD
$d3 << EOD
16 0.6
32 0.6
64 0.6
128 0.6
256 0.6
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.075
set rmargin at screen 0.328333
set tmargin at screen 0.4625
set bmargin at screen 0.19
set title 'torus: error against time' font ',13' offset 0,-0.5
set logscale xy
set xrange [*:*]
set yrange [*:*]
set xtics auto
set format x '%g'
set format y '%.0e'
set xlabel 'CPU time [ms]'
set ylabel 'greatest error / R_curv'
$d0 << EOD
3.42997 0.00010241
13.298 1.13097e-05
51.7377 1.41228e-06
233.069 1.8092e-07
1170.91 2.17428e-08
EOD
$d1 << EOD
7.98015 0.00666409
19.8901 0.00177346
68.2566 0.000429582
266.151 0.0001101
1073.62 2.77982e-05
EOD
$d2 << EOD
5.67183 0.0117818
3.51647 0.00614914
13.6584 0.00423002
14.1847 0.00237343
41.7517 0.00118937
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle
set lmargin at screen 0.403333
set rmargin at screen 0.656667
set tmargin at screen 0.4625
set bmargin at screen 0.19
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
16 0.482581
32 1.00748
64 2.77219
128 6.22181
256 12.4715
EOD
$d3 << EOD
16 0.00074854
32 0.000275484
64 0.00012229
128 5.9186e-05
256 2.92436e-05
EOD
$d4 << EOD
16 0.126898
32 0.126982
64 0.126931
128 0.126938
256 0.126929
EOD
$d5 << EOD
16 0.00135976
32 0.000390993
64 0.000103924
128 2.65034e-05
256 7.39505e-06
EOD
$d6 << EOD
16 0.5
32 0.5
64 0.5
128 0.5
256 0.5
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' notitle, $d4 with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' notitle, $d5 with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' notitle, $d6 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
set lmargin at screen 0.731667
set rmargin at screen 0.985
set tmargin at screen 0.4625
set bmargin at screen 0.19
set title 'torus: cost of a vertex' font ',13' offset 0,-0.5
set xlabel 'R/h'
set xrange [13:315]
set xtics (16,32,64,128,256)
set format y '%g'
set yrange [0.05:10]
set ylabel 'CPU time [µs / vertex]'
$d0 << EOD
16 0.522145
32 0.506109
64 0.491798
128 0.553974
256 0.695759
EOD
$d1 << EOD
16 1.28878
32 0.805072
64 0.690535
128 0.672991
256 0.678737
EOD
$d2 << EOD
16 1.10347
32 0.537687
64 0.822795
128 0.546197
256 0.773509
EOD
$d3 << EOD
16 0.6
32 0.6
64 0.6
128 0.6
256 0.6
EOD
plot $d0 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' notitle, $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' notitle, $d2 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' notitle, $d3 with lines lw 1.5 dt 2 lc rgb '#b00000' notitle
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
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' title 'Argil, finest voxels everywhere', NaN with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' title 'OpenVDB volumeToMesh, the same field', NaN with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' title 'Argil, the clay as it is kept', NaN with lines lw 1.5 dt 2 lc rgb '#b00000' title 'asked: 0.5 h²/R, 0.6 µs', NaN with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' title 'Argil, rms', NaN with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' title 'OpenVDB, rms', NaN with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' title 'Argil, greatest of vertices on edges'
unset multiplot
