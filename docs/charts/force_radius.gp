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
set label 2 'Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the measured 95 GB/s (64 KiB) or 82 GB/s (1 MiB).' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
4 53.15
8 426.03
16 3385.1
32 26773
64 2.1133e+05
128 1.6909e+06
EOD
$blanch_32 << EOD
4 4558.8
8 4568.8
16 4543.7
32 3971.9
64 3420
128 3077.5
EOD
$energy_32 << EOD
4 3750
8 3751.8
16 3774.6
32 3739.5
64 3723.2
128 3677
EOD
$blanch_16 << EOD
4 577.95
8 577.68
16 571.66
32 503.92
64 439.69
128 398.72
EOD
$energy_16 << EOD
4 475.77
8 475.5
16 476.29
32 475.83
64 474.56
128 468.29
EOD
$blanch_8 << EOD
4 70.965
8 70.885
16 69.794
32 61.091
64 52.208
128 48.112
EOD
$energy_8 << EOD
4 58.537
8 58.496
16 58.437
32 57.705
64 57.186
128 56.824
EOD
$stencil_768 << EOD
4 21.734
8 21.973
16 22.864
32 22.113
64 20.211
128 22.643
EOD
$stencil_288 << EOD
4 8.183
8 8.353
16 8.744
32 8.353
64 7.582
128 7.141
EOD
$stencil_96 << EOD
4 2.755
8 2.835
16 2.985
32 2.834
64 2.554
128 2.423
EOD
$lod_blanch << EOD
4 4.116
8 4.107
16 4.116
32 4.107
64 4.117
128 4.106
EOD
$lod << EOD
4 3.425
8 3.426
16 3.426
32 3.425
64 3.435
128 3.425
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
4 0.047304
8 0.37843
16 3.4949
32 27.959
64 223.67
128 1789.4
EOD
$floor_lod << EOD
4 0.047905
8 0.047863
16 0.047821
32 0.047779
64 0.047779
128 0.048074
EOD
plot $fine with linespoints pt 11 ps 1 lw 2 lc rgb '#000000' title 'fine: every finest voxel', $blanch_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 32', $energy_32 with linespoints pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2' title 'energy, N = 32', $blanch_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 16', $energy_16 with linespoints pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2' title 'energy, N = 16', $blanch_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9' title 'blanch, N = 8', $energy_8 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2' title 'energy, N = 8', $stencil_768 with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00' title 'stencil, 768 points', $stencil_288 with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00' title 'stencil, 288 points', $stencil_96 with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00' title 'stencil, 96 points', $lod_blanch with linespoints pt 13 ps 1 lw 2 lc rgb '#cc79a7' title 'lod, blanch law', $lod with linespoints pt 13 ps 1.5 lw 3 lc rgb '#d55e00' title 'lod (default)', $point with linespoints pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f' title 'point: the tool’s centre', $floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', $floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'
