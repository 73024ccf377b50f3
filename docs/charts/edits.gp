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
set label 2 'Argil is not ahead of Blender on a mesh that stays as it is: a dab takes it 2.5 to 4.9 (draw), 3.7 to 11 (smooth), 9.4 to 31 (crease), 6.2 to 37 (grab) times as long.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set label 3 'With dynamic topology Blender takes 5.1 to 26 times as long as Argil for a dab of drawing, with the voxel remesher 16 to 82 times for a stroke: above 1 Argil is ahead.' at screen 0.03,0.902 font ',11' textcolor rgb '#606060'
set label 4 'Mean errors in voxels: Argil 0.0096 to 0.031; Blender on the mesh as it is 0.0058 to 0.044; with dynamic topology 0.0061 to 0.88; with the remesher 0.011 to 0.049.' at screen 0.03,0.879 font ',11' textcolor rgb '#606060'
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
1106 2.0781
11174 5.15255
54343 16.7595
EOD
$d1 << EOD
1143 2.17538
11230 6.15056
56063 17.048
EOD
$d2 << EOD
1110 5.22677
11168 24.707
54340 202.802
EOD
$d3 << EOD
1133 4.66135
EOD
$d4 << EOD
1107 1.21369
11172 5.16372
54351 12.2647
EOD
$d5 << EOD
1123 2.14742
11243 6.3807
56041 12.6519
EOD
$d6 << EOD
998 0.399437
10144 1.52179
50732 4.97565
EOD
$d7 << EOD
993 0.676635
9970 1.69988
50068 4.60036
EOD
$d8 << EOD
998 6.1685
10144 38.8059
50732 319.635
EOD
$d9 << EOD
10144 458.184
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
1110 5.0018
11168 14.8556
54340 41.5176
EOD
$d1 << EOD
1133 6.25507
11238 14.2521
56036 53.2846
EOD
$d2 << EOD
998 0.504604
10144 2.88882
50732 8.76931
EOD
$d3 << EOD
993 0.59529
9970 2.52422
50068 13.14
EOD
$d4 << EOD
998 3.96233
10144 26.3094
EOD
$d5 << EOD
10144 530.05
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'crease' font ',13' offset 0,-0.5
$d0 << EOD
1110 4.68095
11168 30.6515
54340 124.286
EOD
$d1 << EOD
1133 9.12875
EOD
$d2 << EOD
998 0.326243
10144 1.36825
50732 3.98651
EOD
$d3 << EOD
993 0.975606
9970 2.33964
50068 6.20886
EOD
$d4 << EOD
998 20.2306
10144 134.343
EOD
$d5 << EOD
10144 510.512
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'grab' font ',13' offset 0,-0.5
$d0 << EOD
1110 4.07023
11168 26.017
54340 126.958
EOD
$d1 << EOD
1133 4.74785
EOD
$d2 << EOD
998 0.417283
10144 0.843341
50732 3.41309
EOD
$d3 << EOD
993 0.403281
9970 1.15823
50068 3.14221
EOD
$d4 << EOD
10144 5.60721
EOD
$d5 << EOD
10144 475.835
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
2.37477 0.0255216
5.83589 0.0166691
EOD
$d1 << EOD
5.15226 0.0249748
25.3305 0.0305505
EOD
$d2 << EOD
1.38293 0.027055
5.57184 0.0152599
EOD
$d3 << EOD
0.469167 0.00695658
1.58014 0.00578554
EOD
$d4 << EOD
6.58639 0.109145
47.4999 0.877508
EOD
$d5 << EOD
458.184 0.0113801
EOD
plot $d0 with linespoints lw 1 pt 6 ps 0.9 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 4 ps 0.8 lc rgb '#56b4e9' notitle, $d2 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d3 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.30875
set rmargin at screen 0.4975
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'smooth: time and error' font ',13' offset 0,-0.5
$d0 << EOD
5.34863 0.0095745
15.9122 0.0121799
EOD
$d1 << EOD
0.603018 0.0443012
3.02272 0.0427877
EOD
$d2 << EOD
3.60891 0.0519285
26.2933 0.0487546
EOD
$d3 << EOD
530.05 0.0486684
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'crease: time and error' font ',13' offset 0,-0.5
$d0 << EOD
5.57488 0.0138001
32.9323 0.0153629
EOD
$d1 << EOD
0.412567 0.00697932
1.42254 0.00650007
EOD
$d2 << EOD
19.3828 0.0801099
123.051 0.279547
EOD
$d3 << EOD
510.512 0.0158088
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'grab: time and error' font ',13' offset 0,-0.5
$d0 << EOD
5.1382 0.0145652
29.4915 0.0148585
EOD
$d1 << EOD
0.494261 0.00644367
0.939346 0.0060806
EOD
$d2 << EOD
6.47159 0.00606258
EOD
$d3 << EOD
475.835 0.0229454
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
