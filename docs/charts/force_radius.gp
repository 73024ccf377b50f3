# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1100,680 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_radius.svg'
set logscale xy
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: time against the tool’s radius (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the measured 95 GB/s (64 KiB) or 86 GB/s (1 MiB).' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
set lmargin at screen 0.085
set rmargin at screen 0.73
set tmargin at screen 0.88
set bmargin at screen 0.1
set xrange [3.6:142]
set xtics (4, 8, 16, 32, 64, 128)
set yrange [0.02:3e6]
set ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1 000' 1e3, '10 000' 1e4, '100 000' 1e5, '1 000 000' 1e6)
set xlabel 'radius of the tool [finest voxels]'
set ylabel 'time of a query [µs]'
set arrow 1 from graph 0, first 1000 to graph 1, first 1000 nohead lc rgb '#b0b0b0' dt 2
set label 3 'one tick of 1 kHz' at graph 0.015, first 1350 font ',10' textcolor rgb '#707070'
set key at screen 0.985,0.88 right top Left reverse samplen 2.4 spacing 1.25 font ',11'
$fine << EOD
4 53.14
8 430.87
16 3387
32 26745
64 2.1209e+05
128 1.6889e+06
EOD
$blanch_32 << EOD
4 4583.8
8 4576.5
16 4516.2
32 3694.5
64 3247.7
128 2947.6
EOD
$energy_32 << EOD
4 3395
8 3389.3
16 3386.6
32 3317.3
64 3293.6
128 3291.1
EOD
$blanch_16 << EOD
4 579.59
8 575.83
16 572.1
32 502.31
64 438.24
128 398.41
EOD
$energy_16 << EOD
4 431.37
8 425.98
16 427.72
32 428.14
64 424.62
128 421.35
EOD
$blanch_8 << EOD
4 71.286
8 71.206
16 69.855
32 60.049
64 52.318
128 48.222
EOD
$energy_8 << EOD
4 52.889
8 52.818
16 52.799
32 51.836
64 51.216
128 50.926
EOD
$stencil_768 << EOD
4 21.792
8 22.003
16 22.774
32 22.334
64 20.4
128 22.344
EOD
$stencil_288 << EOD
4 8.183
8 8.372
16 8.683
32 8.403
64 7.591
128 7.151
EOD
$stencil_96 << EOD
4 2.754
8 2.824
16 2.974
32 2.854
64 2.563
128 2.454
EOD
$lod_blanch << EOD
4 4.116
8 4.116
16 4.116
32 4.117
64 4.116
128 4.126
EOD
$lod << EOD
4 3.426
8 3.426
16 3.435
32 3.435
64 3.426
128 3.426
EOD
$point << EOD
4 0.14
8 0.14
16 0.14
32 0.14
64 0.14
128 0.14
EOD
$floor_fine << EOD
4 0.046904
8 0.37523
16 3.347
32 26.776
64 214.21
128 1713.7
EOD
$floor_lod << EOD
4 0.0475
8 0.047458
16 0.047416
32 0.047374
64 0.047374
128 0.047667
EOD
plot $fine with linespoints pt 11 ps 1 lw 2 lc rgb '#000000' title 'fine: every finest voxel', $blanch_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 32', $energy_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2' title 'energy, N = 32', $blanch_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 16', $energy_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2' title 'energy, N = 16', $blanch_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 8', $energy_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy, N = 8', $stencil_768 with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00' title 'stencil, 768 points', $stencil_288 with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00' title 'stencil, 288 points', $stencil_96 with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil, 96 points', $lod_blanch with linespoints pt 13 ps 1 lw 2 lc rgb '#cc79a7' title 'lod, blanch law', $lod with linespoints pt 13 ps 1.5 lw 3 lc rgb '#d55e00' title 'lod (default)', $point with linespoints pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f' title 'point: the tool’s centre', $floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', $floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'
