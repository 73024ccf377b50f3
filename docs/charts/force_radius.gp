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
set label 2 'Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the measured 95 GB/s (64 KiB) or 83 GB/s (1 MiB).' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
4 53.069
8 450.02
16 3371.5
32 27848
64 2.1131e+05
128 1.6784e+06
EOD
$blanch_32 << EOD
4 4563.9
8 4540
16 4486.2
32 3669.3
64 3280.6
128 2955.2
EOD
$energy_32 << EOD
4 3394
8 3384.2
16 3408.3
32 3354.4
64 3304.5
128 3273.2
EOD
$blanch_16 << EOD
4 578.36
8 574.97
16 569.45
32 500.92
64 432.48
128 396.39
EOD
$energy_16 << EOD
4 433.25
8 427.04
16 429.17
32 429.95
64 425.55
128 421.98
EOD
$blanch_8 << EOD
4 70.956
8 70.865
16 69.543
32 59.89
64 52.178
128 48.041
EOD
$energy_8 << EOD
4 53.038
8 52.92
16 52.879
32 51.938
64 51.287
128 51.007
EOD
$stencil_768 << EOD
4 21.754
8 22.003
16 22.744
32 22.343
64 20.66
128 22.793
EOD
$stencil_288 << EOD
4 8.213
8 8.362
16 8.703
32 8.363
64 7.602
128 7.15
EOD
$stencil_96 << EOD
4 2.754
8 2.834
16 2.966
32 2.844
64 2.553
128 2.423
EOD
$lod_blanch << EOD
4 4.116
8 4.107
16 4.116
32 4.107
64 4.116
128 4.096
EOD
$lod << EOD
4 3.425
8 3.425
16 3.426
32 3.435
64 3.426
128 3.416
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
4 0.047091
8 0.37672
16 3.4378
32 27.503
64 220.02
128 1760.2
EOD
$floor_lod << EOD
4 0.047689
8 0.047647
16 0.047605
32 0.047563
64 0.047563
128 0.047857
EOD
plot $fine with linespoints pt 11 ps 1 lw 2 lc rgb '#000000' title 'fine: every finest voxel', $blanch_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 32', $energy_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2' title 'energy, N = 32', $blanch_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 16', $energy_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2' title 'energy, N = 16', $blanch_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 8', $energy_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy, N = 8', $stencil_768 with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00' title 'stencil, 768 points', $stencil_288 with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00' title 'stencil, 288 points', $stencil_96 with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil, 96 points', $lod_blanch with linespoints pt 13 ps 1 lw 2 lc rgb '#cc79a7' title 'lod, blanch law', $lod with linespoints pt 13 ps 1.5 lw 3 lc rgb '#d55e00' title 'lod (default)', $point with linespoints pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f' title 'point: the tool’s centre', $floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', $floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'
