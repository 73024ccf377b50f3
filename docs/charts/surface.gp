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
1.82595 0.00144126
7.70296 0.000615952
27.2906 0.000306752
121.896 0.000155722
498.024 7.78157e-05
EOD
$d1 << EOD
12.5934 0.00144541
19.4862 0.000359525
34.4136 9.03168e-05
123.766 2.26185e-05
453.776 5.68721e-06
EOD
$d2 << EOD
0.511848 0.00570987
1.64101 0.00152213
1.74913 0.00168418
6.29835 0.000620085
6.28871 0.000617746
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
16 0.368963
32 0.630735
64 1.25646
128 2.55135
256 5.09973
EOD
$d1 << EOD
16 0.370025
32 0.368153
64 0.369937
128 0.370581
256 0.372717
EOD
$d2 << EOD
16 1.46173
32 1.55866
64 6.89839
128 10.1595
256 40.4846
EOD
$d3 << EOD
16 0.0913335
32 0.0999105
64 0.134204
128 0.221944
256 0.418608
EOD
$d4 << EOD
16 0.242011
32 0.241958
64 0.241989
128 0.242
256 0.242023
EOD
$d5 << EOD
16 0.124725
32 0.124866
64 0.124919
128 0.124973
256 0.124977
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
16 0.361145
32 0.38124
64 0.337772
128 0.377123
256 0.38524
EOD
$d1 << EOD
16 2.60732
32 1.00912
64 0.44568
128 0.400714
256 0.367318
EOD
$d2 << EOD
16 0.408172
32 0.325017
64 0.347948
128 0.311753
256 0.311122
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
1.75142 0.0066641
7.89587 0.00179671
31.9737 0.000774262
122.499 0.000388812
581.77 0.000194928
EOD
$d1 << EOD
3.02178 0.00666409
10.1374 0.00177346
50.2555 0.000429582
152.998 0.0001101
601.361 2.77982e-05
EOD
$d2 << EOD
3.10386 0.0193328
3.06847 0.00688103
11.6794 0.00630056
9.32026 0.00329935
30.0784 0.00159674
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
16 0.272962
32 0.294374
64 0.50742
128 1.01925
256 2.04397
EOD
$d1 << EOD
16 0.272961
32 0.290564
64 0.281531
128 0.28862
256 0.291485
EOD
$d2 << EOD
16 0.791872
32 1.12739
64 4.12914
128 8.64906
256 16.743
EOD
$d3 << EOD
16 0.0531907
32 0.0565878
64 0.0659592
128 0.0949321
256 0.167813
EOD
$d4 << EOD
16 0.126898
32 0.126982
64 0.126931
128 0.126938
256 0.126929
EOD
$d5 << EOD
16 0.123887
32 0.123371
64 0.123992
128 0.124566
256 0.124927
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
16 0.266619
32 0.300509
64 0.30393
128 0.291163
256 0.345689
EOD
$d1 << EOD
16 0.488014
32 0.410322
64 0.508422
128 0.386872
256 0.380176
EOD
$d2 << EOD
16 0.603864
32 0.469185
64 0.703578
128 0.358886
256 0.557244
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
plot [0:1][0:1] NaN with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2' title 'Argil, finest voxels everywhere', NaN with linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00' title 'OpenVDB volumeToMesh, the same field', NaN with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' title 'Argil, the clay as it is kept', NaN with lines lw 1.5 dt 2 lc rgb '#b00000' title 'asked: 0.5 h²/R, 0.6 µs', NaN with linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2' title 'Argil, rms', NaN with linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00' title 'OpenVDB, rms', NaN with linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2' title 'Argil, greatest of cuts not clamped'
unset multiplot
