# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,520 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_whole.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Force: from hand to force (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls, all scenes, medians of thread CPU time; windows with a margin of one radius (none: no slot holds it). Dashed: a tick of 1 kHz; dotted: the 5 ms from window to window.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set logscale x
set xrange [0.05:2e7]
set yrange [-0.7:10.7]
set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' 1e4, '10⁵' 1e5)
set arrow 1 from first 1000, graph 0 to first 1000, graph 1 nohead lc rgb '#b0b0b0' dt 2
set arrow 2 from first 5000, graph 0 to first 5000, graph 1 nohead lc rgb '#b0b0b0' dt 3
set xlabel 'from hand to force [µs]'
unset key
set lmargin at screen 0.115
set rmargin at screen 0.391667
set tmargin at screen 0.82
set bmargin at screen 0.2
set title 'R = 4 finest voxels' font ',13' offset 0,-0.5
set ytics ('fine' 0, 'stencil, 288' 1, 'blanch, N = 32' 2, 'blanch, N = 8' 3, 'energy, N = 32' 4, 'energy, N = 16' 5, 'energy, N = 8' 6, 'lod, blanch' 7, 'lod' 8, 'servo (default)' 9, 'point' 10)
set label 20 'error p95' at graph 0.985, graph 1.025 right font ',10'
set label 21 '0.2 %' at graph 0.985, first 0 right font ',10' textcolor rgb '#404040'
set label 22 '4.96 %' at graph 0.985, first 1 right font ',10' textcolor rgb '#404040'
set label 23 '1.8 %' at graph 0.985, first 2 right font ',10' textcolor rgb '#404040'
set label 24 '5.76 %' at graph 0.985, first 3 right font ',10' textcolor rgb '#404040'
set label 25 '0.9 %' at graph 0.985, first 4 right font ',10' textcolor rgb '#404040'
set label 26 '0.98 %' at graph 0.985, first 5 right font ',10' textcolor rgb '#404040'
set label 27 '0.98 %' at graph 0.985, first 6 right font ',10' textcolor rgb '#404040'
set label 28 '5.76 %' at graph 0.985, first 7 right font ',10' textcolor rgb '#404040'
set label 29 '0.98 %' at graph 0.985, first 8 right font ',10' textcolor rgb '#404040'
set label 30 '0.99 %' at graph 0.985, first 9 right font ',10' textcolor rgb '#404040'
set label 31 '51.84 %' at graph 0.985, first 10 right font ',10' textcolor rgb '#404040'
$d0 << EOD
88.297 0
14963.3 0

13.814 1
14888.8 1

6004.3 2
28805.4 2

103.073 3
14978.1 3

4431.23 4
27232.3 4

573.415 5
17422.8 5

72.527 6
14947.6 6

8.627 7
14883.7 7

6.473 8
14881.5 8

6.392 9
14881.4 9

0.181 10
9678.39 10

EOD
$d1 << EOD
88.297 0
13.814 1
6004.3 2
103.073 3
4431.23 4
573.415 5
72.527 6
8.627 7
6.473 8
6.392 9
0.181 10
EOD
$d2 << EOD
1798.82 0
1724.34 1
9256.57 2
1813.6 3
7683.5 4
2829.03 5
1783.05 6
1719.15 7
1717 8
1716.92 9
709.662 10
EOD
$d3 << EOD
13313.7 0
13239.2 1
48028.3 2
13328.5 3
46455.3 4
25910.6 5
13297.9 6
13234 7
13231.9 8
13231.8 9
7820.2 10
EOD
$d4 << EOD
14963.3 0
14888.8 1
28805.4 2
14978.1 3
27232.3 4
17422.8 5
14947.6 6
14883.7 7
14881.5 8
14881.4 9
9678.39 10
EOD
plot $d0 with lines lw 2 lc rgb '#c8c8c8' notitle, $d1 with points pt 7 ps 0.9 lc rgb '#000000' notitle, $d2 with points pt 5 ps 0.9 lc rgb '#009e73' notitle, $d3 with points pt 9 ps 1.1 lc rgb '#0072b2' notitle, $d4 with points pt 13 ps 1.2 lc rgb '#d55e00' notitle
unset label 1
unset label 2
set lmargin at screen 0.411667
set rmargin at screen 0.688333
set tmargin at screen 0.82
set bmargin at screen 0.2
set title 'R = 16 finest voxels' font ',13' offset 0,-0.5
set ytics ('' 0, '' 1, '' 2, '' 3, '' 4, '' 5, '' 6, '' 7, '' 8, '' 9, '' 10)
set label 20 'error p95' at graph 0.985, graph 1.025 right font ',10'
set label 21 '0.05 %' at graph 0.985, first 0 right font ',10' textcolor rgb '#404040'
set label 22 '4.81 %' at graph 0.985, first 1 right font ',10' textcolor rgb '#404040'
set label 23 '2.28 %' at graph 0.985, first 2 right font ',10' textcolor rgb '#404040'
set label 24 '8.01 %' at graph 0.985, first 3 right font ',10' textcolor rgb '#404040'
set label 25 '0.58 %' at graph 0.985, first 4 right font ',10' textcolor rgb '#404040'
set label 26 '0.9 %' at graph 0.985, first 5 right font ',10' textcolor rgb '#404040'
set label 27 '0.84 %' at graph 0.985, first 6 right font ',10' textcolor rgb '#404040'
set label 28 '8.1 %' at graph 0.985, first 7 right font ',10' textcolor rgb '#404040'
set label 29 '0.84 %' at graph 0.985, first 8 right font ',10' textcolor rgb '#404040'
set label 30 '0.84 %' at graph 0.985, first 9 right font ',10' textcolor rgb '#404040'
set label 31 '78.86 %' at graph 0.985, first 10 right font ',10' textcolor rgb '#404040'
$d0 << EOD
4368.22 0
77994.6 0

10.42 1
73636.8 1

6095.56 2
79722 2

104.647 3
28634.6 3

4450.15 4
78076.6 4

628.048 5
85799.6 5

75.472 6
28605.4 6

10.63 7
28540.5 7

8.676 8
28538.6 8

8.596 9
28538.5 9

0.231 10
25694.8 10

EOD
$d1 << EOD
4368.22 0
10.42 1
6095.56 2
104.647 3
4450.15 4
628.048 5
75.472 6
10.63 7
8.676 8
8.596 9
0.231 10
EOD
$d2 << EOD
11013.4 0
6655.58 1
12740.7 2
2165.43 3
11095.3 4
5955.72 5
2136.26 6
2071.42 7
2069.46 8
2069.38 9
2951.08 10
EOD
$d3 << EOD
112219 0
107861 1
113947 2
19194.3 3
112301 4
79362.9 5
19165.1 6
19100.3 7
19098.3 8
19098.2 9
39065.4 10
EOD
$d4 << EOD
77994.6 0
73636.8 1
79722 2
28634.6 3
78076.6 4
85799.6 5
28605.4 6
28540.5 7
28538.6 8
28538.5 9
25694.8 10
EOD
plot $d0 with lines lw 2 lc rgb '#c8c8c8' notitle, $d1 with points pt 7 ps 0.9 lc rgb '#000000' notitle, $d2 with points pt 5 ps 0.9 lc rgb '#009e73' notitle, $d3 with points pt 9 ps 1.1 lc rgb '#0072b2' notitle, $d4 with points pt 13 ps 1.2 lc rgb '#d55e00' notitle
set lmargin at screen 0.708333
set rmargin at screen 0.985
set tmargin at screen 0.82
set bmargin at screen 0.2
set title 'R = 64 finest voxels' font ',13' offset 0,-0.5
set ytics ('' 0, '' 1, '' 2, '' 3, '' 4, '' 5, '' 6, '' 7, '' 8, '' 9, '' 10)
set label 20 'error p95' at graph 0.985, graph 1.025 right font ',10'
set label 21 '' at graph 0.985, first 0 right font ',10' textcolor rgb '#404040'
set label 22 '10.16 %' at graph 0.985, first 1 right font ',10' textcolor rgb '#404040'
set label 23 '4.52 %' at graph 0.985, first 2 right font ',10' textcolor rgb '#404040'
set label 24 '13.75 %' at graph 0.985, first 3 right font ',10' textcolor rgb '#404040'
set label 25 '0.06 %' at graph 0.985, first 4 right font ',10' textcolor rgb '#404040'
set label 26 '0.24 %' at graph 0.985, first 5 right font ',10' textcolor rgb '#404040'
set label 27 '0.9 %' at graph 0.985, first 6 right font ',10' textcolor rgb '#404040'
set label 28 '14.36 %' at graph 0.985, first 7 right font ',10' textcolor rgb '#404040'
set label 29 '1.16 %' at graph 0.985, first 8 right font ',10' textcolor rgb '#404040'
set label 30 '1.16 %' at graph 0.985, first 9 right font ',10' textcolor rgb '#404040'
set label 31 '102.56 %' at graph 0.985, first 10 right font ',10' textcolor rgb '#404040'
$d0 << EOD
4462.54 2
127856 2

70.933 3
22105 3

4340.73 4
127735 4

537.899 5
67970.2 5

64.892 6
22098.9 6

8.115 7
22042.2 7

6.192 8
22040.2 8

6.242 9
22040.3 9

0.18 10
41462.4 10

EOD
$d1 << EOD
328699 0
14.267 1
4462.54 2
70.933 3
4340.73 4
537.899 5
64.892 6
8.115 7
6.192 8
6.242 9
0.18 10
EOD
$d2 << EOD
15090 2
2762.77 3
14968.2 4
7153.71 5
2756.73 6
2699.95 7
2698.03 8
2698.08 9
4567.78 10
EOD
$d3 << EOD
211402 2
16480.3 3
211280 4
57411.7 5
16474.2 6
16417.5 7
16415.5 8
16415.6 9
212715 10
EOD
$d4 << EOD
127856 2
22105 3
127735 4
67970.2 5
22098.9 6
22042.2 7
22040.2 8
22040.3 9
41462.4 10
EOD
plot $d0 with lines lw 2 lc rgb '#c8c8c8' notitle, $d1 with points pt 7 ps 0.9 lc rgb '#000000' notitle, $d2 with points pt 5 ps 0.9 lc rgb '#009e73' notitle, $d3 with points pt 9 ps 1.1 lc rgb '#0072b2' notitle, $d4 with points pt 13 ps 1.2 lc rgb '#d55e00' notitle
unset arrow
unset label 20
unset label 21
unset label 22
unset label 23
unset label 24
unset label 25
unset label 26
unset label 27
unset label 28
unset label 29
unset label 30
unset label 31
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
plot [0:1][0:1] NaN with points pt 7 ps 0.9 lc rgb '#000000' title 'the force alone, on a window that is there', NaN with points pt 5 ps 0.9 lc rgb '#009e73' title 'with a window after a move of 4 nodes', NaN with points pt 9 ps 1.1 lc rgb '#0072b2' title 'after a dab of the tool', NaN with points pt 13 ps 1.2 lc rgb '#d55e00' title 'of nothing that was kept'
unset multiplot
