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
set label 2 'Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the measured 58 GB/s (64 KiB) or 51 GB/s (1 MiB).' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
4 101.34
8 555.05
16 4340.5
32 33902
64 3.9826e+05
128 2.471e+06
EOD
$blanch_32 << EOD
4 8197.9
8 7618.2
16 8077
32 6397.3
64 5188.8
128 4237.8
EOD
$energy_32 << EOD
4 4747.6
8 4520.5
16 5181.5
32 5091.8
64 4325.1
128 4127.8
EOD
$blanch_16 << EOD
4 998.63
8 990.33
16 983.45
32 827.37
64 685.2
128 581.36
EOD
$energy_16 << EOD
4 592.21
8 592.48
16 576.21
32 595.17
64 614.05
128 532.54
EOD
$blanch_8 << EOD
4 126.89
8 126.73
16 125.07
32 110.18
64 84.649
128 69.26
EOD
$energy_8 << EOD
4 72.988
8 71.453
16 72.456
32 73.459
64 73.768
128 63.739
EOD
$stencil_768 << EOD
4 38.542
8 27.171
16 33.584
32 48.251
64 110.21
128 114.41
EOD
$stencil_288 << EOD
4 15.039
8 10.271
16 10.911
32 17.883
64 13.206
128 18.163
EOD
$stencil_96 << EOD
4 5.019
8 3.486
16 3.776
32 3.515
64 4.398
128 4.037
EOD
$lod_blanch << EOD
4 8.405
8 10.319
16 8.626
32 10.629
64 10.23
128 8.225
EOD
$lod << EOD
4 6.452
8 6.673
16 6.663
32 8.767
64 8.737
128 6.241
EOD
$servo << EOD
4 6.542
8 6.583
16 6.653
32 8.947
64 8.515
128 6.292
EOD
$point << EOD
4 0.391
8 0.391
16 0.381
32 0.411
64 0.41
128 0.361
EOD
$floor_fine << EOD
4 0.07739
8 0.61912
16 5.615
32 44.92
64 359.36
128 2874.9
EOD
$floor_lod << EOD
4 0.078374
8 0.078304
16 0.078235
32 0.078166
64 0.078166
128 0.07865
EOD
plot $fine with linespoints pt 11 ps 1 lw 2 lc rgb '#000000' title 'fine: every finest voxel', $blanch_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 32', $energy_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2' title 'energy, N = 32', $blanch_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 16', $energy_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2' title 'energy, N = 16', $blanch_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 8', $energy_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy, N = 8', $stencil_768 with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00' title 'stencil, 768 points', $stencil_288 with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00' title 'stencil, 288 points', $stencil_96 with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil, 96 points', $lod_blanch with linespoints pt 13 ps 1 lw 2 lc rgb '#cc79a7' title 'lod, blanch law', $lod with linespoints pt 13 ps 1.5 lw 3 lc rgb '#d55e00' title 'lod', $servo with linespoints pt 12 ps 1.5 lw 2 lc rgb '#009e73' title 'servo (default): lod or centre', $point with linespoints pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f' title 'point: the tool’s centre', $floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', $floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'
