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
set label 23 '1.66 %' at graph 0.985, first 2 right font ',10' textcolor rgb '#404040'
set label 24 '5.76 %' at graph 0.985, first 3 right font ',10' textcolor rgb '#404040'
set label 25 '0.9 %' at graph 0.985, first 4 right font ',10' textcolor rgb '#404040'
set label 26 '0.98 %' at graph 0.985, first 5 right font ',10' textcolor rgb '#404040'
set label 27 '0.98 %' at graph 0.985, first 6 right font ',10' textcolor rgb '#404040'
set label 28 '5.76 %' at graph 0.985, first 7 right font ',10' textcolor rgb '#404040'
set label 29 '0.98 %' at graph 0.985, first 8 right font ',10' textcolor rgb '#404040'
set label 30 '0.96 %' at graph 0.985, first 9 right font ',10' textcolor rgb '#404040'
set label 31 '51.58 %' at graph 0.985, first 10 right font ',10' textcolor rgb '#404040'
$d0 << EOD
101.339 0
11128.6 0

15.039 1
11042.3 1

8197.91 2
30436.3 2

126.887 3
11154.1 3

4747.59 4
26985.9 4

592.21 5
16786.4 5

72.988 6
11100.2 6

8.405 7
11035.7 7

6.452 8
11033.7 8

6.542 9
11033.8 9

0.391 10
5701.8 10

EOD
$d1 << EOD
101.339 0
15.039 1
8197.91 2
126.887 3
4747.59 4
592.21 5
72.988 6
8.405 7
6.452 8
6.542 9
0.391 10
EOD
$d2 << EOD
1520.75 0
1434.45 1
11613.1 2
1546.3 3
8162.75 4
2976.41 5
1492.4 6
1427.82 7
1425.86 8
1425.95 9
586.539 10
EOD
$d3 << EOD
9953.93 0
9867.63 1
33308.9 2
9979.48 3
29858.6 4
19217.4 5
9925.58 6
9861 7
9859.05 8
9859.14 9
6374.82 10
EOD
$d4 << EOD
11128.6 0
11042.3 1
30436.3 2
11154.1 3
26985.9 4
16786.4 5
11100.2 6
11035.7 7
11033.7 8
11033.8 9
5701.8 10
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
set label 25 '0.3 %' at graph 0.985, first 4 right font ',10' textcolor rgb '#404040'
set label 26 '0.4 %' at graph 0.985, first 5 right font ',10' textcolor rgb '#404040'
set label 27 '0.27 %' at graph 0.985, first 6 right font ',10' textcolor rgb '#404040'
set label 28 '8.1 %' at graph 0.985, first 7 right font ',10' textcolor rgb '#404040'
set label 29 '0.28 %' at graph 0.985, first 8 right font ',10' textcolor rgb '#404040'
set label 30 '0.31 %' at graph 0.985, first 9 right font ',10' textcolor rgb '#404040'
set label 31 '76.46 %' at graph 0.985, first 10 right font ',10' textcolor rgb '#404040'
$d0 << EOD
4340.55 0
96179.2 0

10.911 1
91849.6 1

8077.04 2
99915.7 2

125.074 3
25924.8 3

5181.53 4
97020.2 4

576.212 5
106047 5

72.456 6
25872.2 6

8.626 7
25808.3 7

6.663 8
25806.4 8

6.653 9
25806.4 9

0.381 10
27106.2 10

EOD
$d1 << EOD
4340.55 0
10.911 1
8077.04 2
125.074 3
5181.53 4
576.212 5
72.456 6
8.626 7
6.663 8
6.653 9
0.381 10
EOD
$d2 << EOD
10496.6 0
6166.96 1
14233.1 2
2101.22 3
11337.6 4
6404.86 5
2048.6 6
1984.77 7
1982.81 8
1982.8 9
2403.66 10
EOD
$d3 << EOD
89522.8 0
85193.2 1
93259.3 2
19606 3
90363.8 4
83584.1 5
19553.4 6
19489.5 7
19487.6 8
19487.6 9
30439.5 10
EOD
$d4 << EOD
96179.2 0
91849.6 1
99915.7 2
25924.8 3
97020.2 4
106047 5
25872.2 6
25808.3 7
25806.4 8
25806.4 9
27106.2 10
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
5188.84 2
202228 2

84.649 3
23866 3

4325.06 4
201364 4

614.053 5
83100.5 5

73.768 6
23855.1 6

10.23 7
23791.6 7

8.737 8
23790.1 8

8.515 9
23789.9 9

0.41 10
53746.6 10

EOD
$d1 << EOD
398263 0
13.206 1
5188.84 2
84.649 3
4325.06 4
614.053 5
73.768 6
10.23 7
8.737 8
8.515 9
0.41 10
EOD
$d2 << EOD
17927.1 2
2466.97 3
17063.3 4
7191.77 5
2456.08 6
2392.55 7
2391.05 8
2390.83 9
6175.81 10
EOD
$d3 << EOD
156762 2
13259.4 3
155898 4
67689.3 5
13248.5 6
13185 7
13183.5 8
13183.3 9
102763 10
EOD
$d4 << EOD
202228 2
23866 3
201364 4
83100.5 5
23855.1 6
23791.6 7
23790.1 8
23789.9 9
53746.6 10
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
