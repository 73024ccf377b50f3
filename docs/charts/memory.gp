# Made by 'argil chart memory'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'memory.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Memory: what detail costs, and what levels save' at screen 0.03,0.965 font ',16'
set label 2 'A ball with bumps everywhere, R/h its detail; and pieces that are plain in most places.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set xlabel 'R/h'
set xrange [24:700]
set xtics (32,64,128,256,512)
set lmargin at screen 0.07
set rmargin at screen 0.4875
set tmargin at screen 0.86
set bmargin at screen 0.535
set title 'Bytes for each active voxel' font ',13' offset 0,-0.5
set key at graph 0.98,0.97 right top
set logscale x
set yrange [0:*]
set ylabel 'bytes for each active voxel'
$d0 << EOD
32 32.3617
64 13.1638
128 8.91757
256 7.59948
512 7.35012
EOD
$d1 << EOD
32 6.78096
64 6.79636
128 6.80315
256 6.82882
512 6.85623
EOD
$d2 << EOD
32 16
64 16
128 16
256 16
512 16
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'finest level', $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#56b4e9' title 'its leaves alone', $d2 with lines lw 1.5 dt 2 lc rgb '#b00000' title 'asked from 128 on: at most 16'
unset label 1
unset label 2
set lmargin at screen 0.5625
set rmargin at screen 0.98
set tmargin at screen 0.86
set bmargin at screen 0.535
set title 'Coarser levels, and what the process says' font ',13' offset 0,-0.5
set key at graph 0.98,0.04 right bottom
set yrange [0:*]
set ylabel 'ratio of bytes'
$d0 << EOD
32 2.70693
64 2.74079
128 2.11231
256 1.74103
512 1.56998
EOD
$d1 << EOD
32 1.60133
64 1.56106
128 1.52556
256 1.51508
512 1.50537
EOD
$d2 << EOD
32 1.01777
64 1.00496
128 1.00853
256 1.01182
512 1.01342
EOD
$d3 << EOD
32 1.5
64 1.5
128 1.5
256 1.5
512 1.5
EOD
plot $d0 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'all levels over the finest', $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#56b4e9' title 'the same of the leaves alone', $d2 with points pt 6 ps 1.5 lw 1.5 lc rgb '#d55e00' title 'growth of the process over all levels', $d3 with lines lw 1.5 dt 2 lc rgb '#b00000' title 'asked: at most 1.5'
set key at graph 0.02,0.97 left top Left reverse
set lmargin at screen 0.07
set rmargin at screen 0.4875
set tmargin at screen 0.405
set bmargin at screen 0.08
set title 'Growth with detail' font ',13' offset 0,-0.5
set logscale xy
set format y '%.0s%c'
set yrange [*:*]
set ylabel 'voxels, bytes'
$d0 << EOD
32 95170
64 382341
128 1.53509e+06
256 6.14175e+06
512 2.46408e+07
EOD
$d1 << EOD
32 1.03341e+06
64 4.05645e+06
128 1.59321e+07
256 6.35439e+07
512 2.54321e+08
EOD
$d2 << EOD
32 8.33697e+06
64 1.37945e+07
128 2.8916e+07
256 8.1261e+07
512 2.84344e+08
EOD
$d3 << EOD
32 81920
64 327680
128 1.31072e+06
256 5.24288e+06
512 2.09715e+07
EOD
plot $d0 with linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73' title 'active voxels, grow by 2.00', $d1 with linespoints pt 5 ps 0.8 lw 2 lc rgb '#56b4e9' title 'bytes of leaves, by 1.99', $d2 with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'all bytes, by 1.27', $d3 with lines lw 1.5 dt 3 lc rgb '#606060' title 'a square'
set lmargin at screen 0.5625
set rmargin at screen 0.98
set tmargin at screen 0.405
set bmargin at screen 0.08
set title 'Pieces, and how many times less than every level whole' font ',13' offset 0,-0.5
unset logscale x
set logscale y
set format y '%g'
set yrange [0.5:60000]
set boxwidth 0.85
set xtics ("bunny\n1.6 times" 1,"fandisk\n2.1 times" 5,"rocker\n1.5 times" 9,"engraved ball\n16.8 times" 13)
set xrange [-1:15]
set ylabel 'MB'
unset xlabel
set key at graph 0.98,0.97 right top Right noreverse
$d0 << EOD
0 223.273
4 144.49
8 48.4137
12 2312.04
EOD
$d1 << EOD
1 51.5257
5 44.3792
9 31.9834
13 230.048
EOD
$d2 << EOD
2 31.7623
6 21.299
10 21.6386
14 13.693
EOD
plot $d0 with boxes fs solid 0.9 lc rgb '#bbbbbb' title 'dense grid', $d1 with boxes fs solid 0.9 lc rgb '#e69f00' title 'every level whole', $d2 with boxes fs solid 0.9 lc rgb '#0072b2' title 'as it is'
unset multiplot
