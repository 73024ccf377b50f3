# Made by 'argil chart edits'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,920 font 'DejaVu Sans,12' background rgb 'white'
set output 'edits.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Strokes beside Blender: what they cost, and how exact they are' at screen 0.03,0.965 font ',16'
set label 2 'Argil is not ahead of Blender on a mesh that stays as it is: a dab takes it 3.3 to 7.9 (draw), 9.6 to 24 (smooth), 58 to 160 (crease), 82 to 440 (grab) times as long.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set label 3 'With dynamic topology Blender takes 3.1 to 17 times as long as Argil for a dab of drawing, with the voxel remesher 2.2 to 59 times for a stroke: above 1 Argil is ahead.' at screen 0.03,0.902 font ',11' textcolor rgb '#606060'
set label 4 'Mean errors in voxels: Argil 0.0095 to 0.35; Blender on the mesh as it is 0.0058 to 0.044; with dynamic topology 0.0061 to 0.88; with the remesher 0.011 to 0.049.' at screen 0.03,0.879 font ',11' textcolor rgb '#606060'
set label 5 'Above: a ball of 0.5 million vertices, dotted of 8 million. Below: the whole stroke of 16 dabs, and its distance to the same stroke on edges a quarter as long; down and left is better.' at screen 0.03,0.856 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set format y '%g'
set yrange [*:*]
set xlabel 'vertices under a dab'
set format x '%.0s%c'
set ylabel 'ms a dab'
set lmargin at screen 0.065
set rmargin at screen 0.25375
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'draw' font ',13' offset 0,-0.5
$d0 << EOD
1106 2.76266
11174 9.01572
54343 31.4907
EOD
$d1 << EOD
1143 7.32727
11230 22.2539
56063 19.2362
EOD
$d2 << EOD
1110 8.47165
11168 69.7404
54340 544.177
EOD
$d3 << EOD
1133 10.984
EOD
$d4 << EOD
1107 2.98438
11172 14.3634
54351 25.8064
EOD
$d5 << EOD
1123 4.89403
11243 19.0643
56041 48.3914
EOD
$d6 << EOD
998 0.378503
10144 2.03928
50732 7.71939
EOD
$d7 << EOD
993 0.92665
9970 2.69861
50068 9.82146
EOD
$d8 << EOD
998 9.13014
10144 87.293
50732 451.434
EOD
$d9 << EOD
10144 928.703
EOD
plot $d0 with linespoints lw 2 pt 6 ps 0.9 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 6 ps 0.9 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 4 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with linespoints lw 1 dt 3 pt 4 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d5 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d6 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d7 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d8 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d9 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset label 3
unset label 4
unset label 5
unset ylabel
unset label 1
unset label 2
set lmargin at screen 0.30875
set rmargin at screen 0.4975
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'smooth' font ',13' offset 0,-0.5
$d0 << EOD
1110 7.9291
11168 42.6066
54340 249.257
EOD
$d1 << EOD
1133 9.11671
11238 51.6022
56036 197.711
EOD
$d2 << EOD
998 0.400563
10144 3.4925
50732 15.2935
EOD
$d3 << EOD
993 0.949631
9970 3.2852
50068 17.6418
EOD
$d4 << EOD
998 4.02615
10144 46.6502
EOD
$d5 << EOD
10144 869.203
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'crease' font ',13' offset 0,-0.5
$d0 << EOD
1110 53.833
11168 375.45
54340 1415.64
EOD
$d1 << EOD
1133 42.3488
EOD
$d2 << EOD
998 0.653033
10144 3.41251
50732 8.95493
EOD
$d3 << EOD
993 0.638026
9970 1.8793
50068 7.25343
EOD
$d4 << EOD
998 14.654
10144 93.8106
EOD
$d5 << EOD
10144 1109.2
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'grab' font ',13' offset 0,-0.5
$d0 << EOD
1110 61.6204
11168 538.547
54340 2215.38
EOD
$d1 << EOD
1133 85.1254
EOD
$d2 << EOD
998 0.752071
10144 2.15263
50732 5.02985
EOD
$d3 << EOD
993 0.415654
9970 1.33157
50068 4.39751
EOD
$d4 << EOD
10144 8.70903
EOD
$d5 << EOD
10144 1046.92
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set xlabel 'ms a dab, the whole stroke'
set format x '%g'
set ylabel 'mean error [voxels]'
set lmargin at screen 0.065
set rmargin at screen 0.25375
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'draw: time and error' font ',13' offset 0,-0.5
$d0 << EOD
3.10833 0.0255216
10.2117 0.0166691
EOD
$d1 << EOD
8.94703 0.0244833
87.8632 0.349785
EOD
$d2 << EOD
3.65018 0.027055
15.8425 0.0152599
EOD
$d3 << EOD
0.448142 0.00695657
2.05501 0.00578554
EOD
$d4 << EOD
8.1958 0.109145
82.6923 0.876751
EOD
$d5 << EOD
928.703 0.0113801
EOD
plot $d0 with linespoints lw 1 pt 6 ps 0.9 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 4 ps 0.8 lc rgb '#56b4e9' notitle, $d2 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d3 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.30875
set rmargin at screen 0.4975
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'smooth: time and error' font ',13' offset 0,-0.5
$d0 << EOD
8.60178 0.00951258
46.9746 0.0119232
EOD
$d1 << EOD
0.481333 0.0443012
3.44544 0.042781
EOD
$d2 << EOD
3.7953 0.0521037
45.6048 0.0487505
EOD
$d3 << EOD
869.203 0.0486633
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'crease: time and error' font ',13' offset 0,-0.5
$d0 << EOD
58.2039 0.0142936
410.042 0.0140068
EOD
$d1 << EOD
0.823009 0.00697933
3.44689 0.00650002
EOD
$d2 << EOD
12.8236 0.0800726
91.0989 0.279518
EOD
$d3 << EOD
1109.2 0.0158088
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'grab: time and error' font ',13' offset 0,-0.5
$d0 << EOD
55.9473 0.0145658
479.735 0.0148556
EOD
$d1 << EOD
0.839588 0.00644367
2.28686 0.0060806
EOD
$d2 << EOD
8.09834 0.00606258
EOD
$d3 << EOD
1046.92 0.0229454
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
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
set key center top horizontal maxcols 3 Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'
plot [0:1][0:1] NaN with linespoints lw 1.5 pt 6 ps 0.9 lc rgb '#0072b2' title 'Argil: carve', NaN with linespoints lw 1.5 pt 4 ps 0.8 lc rgb '#56b4e9' title 'Argil: inflate', NaN with linespoints lw 1.5 pt 7 ps 0.8 lc rgb '#0072b2' title 'Argil: add, and other brushes', NaN with linespoints lw 1.5 pt 5 ps 0.8 lc rgb '#e69f00' title 'Blender, the mesh as it is', NaN with linespoints lw 1.5 pt 9 ps 0.9 lc rgb '#009e73' title 'Blender, dynamic topology', NaN with linespoints lw 1.5 pt 13 ps 1.1 lc rgb '#cc79a7' title 'Blender, voxel remesher after each stroke'
unset multiplot
