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
set label 2 'Argil is not ahead of Blender on a mesh that stays as it is: a dab takes it 1.9 to 4.5 (draw), 2.5 to 10 (smooth), 18 to 31 (crease), 19 to 150 (grab) times as long.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set label 3 'With dynamic topology Blender takes 4.3 to 29 times as long as Argil for a dab of drawing, with the voxel remesher 4.6 to 80 times for a stroke: above 1 Argil is ahead.' at screen 0.03,0.902 font ',11' textcolor rgb '#606060'
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
1106 1.36028
11174 5.51906
54343 17.2843
EOD
$d1 << EOD
1143 2.41042
11230 6.36779
56063 15.2222
EOD
$d2 << EOD
1110 4.14636
11168 34.9761
54340 286.188
EOD
$d3 << EOD
1133 4.8279
EOD
$d4 << EOD
1107 1.65121
11172 5.39071
54351 13.818
EOD
$d5 << EOD
1123 3.12668
11243 6.22607
56041 14.1853
EOD
$d6 << EOD
998 0.567151
10144 2.89171
50732 7.19817
EOD
$d7 << EOD
993 0.953317
9970 1.53057
50068 6.22223
EOD
$d8 << EOD
998 7.05468
10144 53.5656
50732 401.811
EOD
$d9 << EOD
10144 489.59
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
1110 5.7428
11168 14.713
54340 58.6879
EOD
$d1 << EOD
1133 6.14534
11238 13.7209
56036 56.2926
EOD
$d2 << EOD
998 0.628734
10144 5.99941
50732 20.9893
EOD
$d3 << EOD
993 0.710228
9970 3.40324
50068 15.234
EOD
$d4 << EOD
998 3.63715
10144 25.7336
EOD
$d5 << EOD
10144 515.133
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'crease' font ',13' offset 0,-0.5
$d0 << EOD
1110 10.0475
11168 62.3869
54340 179.611
EOD
$d1 << EOD
1133 12.912
EOD
$d2 << EOD
998 0.377081
10144 2.00814
50732 10.0083
EOD
$d3 << EOD
993 0.710207
9970 1.85717
50068 6.45041
EOD
$d4 << EOD
998 16.5163
10144 118.711
EOD
$d5 << EOD
10144 532.649
EOD
plot $d0 with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 dt 3 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d2 with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d3 with linespoints lw 1 dt 3 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 2 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 2 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.795
set bmargin at screen 0.5425
set title 'grab' font ',13' offset 0,-0.5
$d0 << EOD
1110 13.9799
11168 113.592
54340 525.956
EOD
$d1 << EOD
1133 17.3511
EOD
$d2 << EOD
998 0.746643
10144 0.951793
50732 3.41677
EOD
$d3 << EOD
993 0.552743
9970 1.0938
50068 3.34603
EOD
$d4 << EOD
10144 13.803
EOD
$d5 << EOD
10144 470.758
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
1.54241 0.0255216
6.12397 0.0166691
EOD
$d1 << EOD
4.55956 0.024994
36.4312 0.0305709
EOD
$d2 << EOD
1.87362 0.027055
6.10752 0.0152599
EOD
$d3 << EOD
0.678537 0.00695659
2.93303 0.00578555
EOD
$d4 << EOD
7.56759 0.109145
59.3166 0.876096
EOD
$d5 << EOD
489.59 0.0113801
EOD
plot $d0 with linespoints lw 1 pt 6 ps 0.9 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 4 ps 0.8 lc rgb '#56b4e9' notitle, $d2 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d3 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d4 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d5 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.30875
set rmargin at screen 0.4975
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'smooth: time and error' font ',13' offset 0,-0.5
$d0 << EOD
6.1255 0.00957514
15.7967 0.0123474
EOD
$d1 << EOD
0.722876 0.0443004
5.7114 0.0427783
EOD
$d2 << EOD
3.53265 0.0519431
25.2457 0.0487676
EOD
$d3 << EOD
515.133 0.0486686
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.5525
set rmargin at screen 0.74125
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'crease: time and error' font ',13' offset 0,-0.5
$d0 << EOD
11.4955 0.0142984
62.2475 0.0140349
EOD
$d1 << EOD
0.470117 0.00697932
2.06569 0.00650003
EOD
$d2 << EOD
14.4058 0.0801221
116.953 0.279724
EOD
$d3 << EOD
532.649 0.0158088
EOD
plot $d0 with linespoints lw 1 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with linespoints lw 1 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d2 with linespoints lw 1 pt 9 ps 0.9 lc rgb '#009e73' notitle, $d3 with linespoints lw 1 pt 13 ps 1.1 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.79625
set rmargin at screen 0.985
set tmargin at screen 0.4175
set bmargin at screen 0.165
set title 'grab: time and error' font ',13' offset 0,-0.5
$d0 << EOD
13.7133 0.0145652
101.833 0.0148585
EOD
$d1 << EOD
0.841502 0.00644367
1.13707 0.0060806
EOD
$d2 << EOD
12.9078 0.00606258
EOD
$d3 << EOD
470.758 0.0229454
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
