# Made by 'argil chart force'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1100,680 font 'DejaVu Sans,12' background rgb 'white'
set output 'force_radius.svg'
set logscale xy
set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' 1e4, '10⁵' 1e5)
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format y '%g'
set format x '%g'
set label 1 'Force: time against the tool’s radius (AMD EPYC, 2 cores)' at screen 0.03,0.965 font ',16'
set label 2 'Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the measured 72 GB/s (64 KiB) or 55 GB/s (1 MiB).' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
4 88.297
8 524.29
16 4368.2
32 36603
64 3.287e+05
128 2.4792e+06
EOD
$blanch_32 << EOD
4 6004.3
8 6867.4
16 6095.6
32 5228.3
64 4462.5
128 3924.7
EOD
$energy_32 << EOD
4 4431.2
8 5140.8
16 4450.2
32 4855.8
64 4340.7
128 4121.9
EOD
$blanch_16 << EOD
4 791.02
8 849.82
16 803.42
32 692.79
64 579.87
128 516.7
EOD
$energy_16 << EOD
4 573.42
8 645.81
16 628.05
32 574.64
64 537.9
128 537.03
EOD
$blanch_8 << EOD
4 103.07
8 108.89
16 104.65
32 84.869
64 70.933
128 61.976
EOD
$energy_8 << EOD
4 72.527
8 78.377
16 75.472
32 71.183
64 64.892
128 64.792
EOD
$stencil_768 << EOD
4 36.83
8 27.352
16 29.314
32 30.767
64 58.801
128 150.77
EOD
$stencil_288 << EOD
4 13.814
8 10.279
16 10.42
32 10.511
64 14.267
128 107.11
EOD
$stencil_96 << EOD
4 4.599
8 3.487
16 3.536
32 3.436
64 4.509
128 4.339
EOD
$lod_blanch << EOD
4 8.627
8 10.961
16 10.63
32 9.948
64 8.115
128 8.135
EOD
$lod << EOD
4 6.473
8 8.826
16 8.676
32 6.402
64 6.192
128 6.202
EOD
$servo << EOD
4 6.392
8 8.646
16 8.596
32 6.643
64 6.242
128 6.252
EOD
$point << EOD
4 0.181
8 0.27
16 0.231
32 0.181
64 0.18
128 0.171
EOD
$floor_fine << EOD
4 0.062021
8 0.49617
16 5.2111
32 41.688
64 333.51
128 2668.1
EOD
$floor_lod << EOD
4 0.062809
8 0.062754
16 0.062698
32 0.062643
64 0.062643
128 0.063031
EOD
plot $fine with linespoints pt 11 ps 1 lw 2 lc rgb '#000000' title 'fine: every finest voxel', $blanch_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 32', $energy_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2' title 'energy, N = 32', $blanch_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 16', $energy_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2' title 'energy, N = 16', $blanch_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 8', $energy_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy, N = 8', $stencil_768 with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00' title 'stencil, 768 points', $stencil_288 with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00' title 'stencil, 288 points', $stencil_96 with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil, 96 points', $lod_blanch with linespoints pt 13 ps 1 lw 2 lc rgb '#cc79a7' title 'lod, blanch law', $lod with linespoints pt 13 ps 1.5 lw 3 lc rgb '#d55e00' title 'lod', $servo with linespoints pt 12 ps 1.5 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $point with linespoints pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f' title 'point: the tool’s centre', $floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', $floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'
