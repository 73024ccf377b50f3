# Made by 'argil chart operations'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1280,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'operations.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'Operations beside others: time and error, as bodies grow' at screen 0.03,0.965 font ',16'
set label 2 'Bodies of 0.1, 0.5 and 2 million vertices, a mark each from left to right; down and left is better. Error: rms in finest voxels from the exact result, 1e-4 and less as one.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
set logscale xy
set format x '%g'
set format y '%g'
set xrange [*:*]
set yrange [*:*]
set xlabel 'CPU time [s]'
set ylabel 'error [voxels]'
set ylabel 'error [voxels]'
set lmargin at screen 0.065
set rmargin at screen 0.2575
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'import' font ',13' offset 0,-0.5
$d0 << EOD
0.631717 0.0230908 0.626213 0.650917
3.18545 0.0208315 3.01064 3.18545
13.5715 0.020007 13.5715 13.5715
EOD
$d1 << EOD
0.747704 0.0187295 0.731612 0.772657
3.85082 0.012742 3.46529 3.85082
14.8408 0.00967307 14.8408 14.8408
EOD
$d2 << EOD
0.623661 0.00381317 0.614628 0.636085
3.16108 0.0034527 2.96358 3.16108
13.6175 0.00330759 13.6175 13.6175
EOD
$d3 << EOD
0.704067 0.0187196 0.701713 0.708991
3.64947 0.0128452 3.40466 3.64947
15.6253 0.0101354 15.6253 15.6253
EOD
$d4 << EOD
1.42735 0.00913764 1.42318 1.42768
7.33002 0.00895671 7.33002 7.33002
28.2541 0.0090687 28.2541 28.2541
EOD
$d5 << EOD
1.40968 0.0274847 1.40118 1.437
7.33761 0.0175696 7.33761 7.33761
29.1299 0.0128561 29.1299 29.1299
EOD
$d6 << EOD
35.1529 0.0325543 35.1529 35.1529
EOD
$d7 << EOD
24.3808 0.0332595 24.3808 24.3808
EOD
$d8 << EOD
1.51738 0.00331384 1.48815 1.54855
7.75242 0.00304264 7.75242 7.75242
32.8238 0.00291409 32.8238 32.8238
EOD
$d9 << EOD
1.65253 0.00992437 1.59855 1.69973
8.21089 0.0064082 8.21089 8.21089
33.5207 0.00434432 33.5207 33.5207
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle, $d6 with xerrorlines lw 2 pt 9 ps 0.8 lc rgb '#009e73' notitle, $d7 with xerrorlines lw 1.2 dt 2 pt 8 ps 0.8 lc rgb '#009e73' notitle, $d8 with xerrorlines lw 2 pt 11 ps 0.8 lc rgb '#cc79a7' notitle, $d9 with xerrorlines lw 1.2 dt 2 pt 10 ps 0.8 lc rgb '#cc79a7' notitle
unset ylabel
unset label 1
unset label 2
set lmargin at screen 0.3075
set rmargin at screen 0.5
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'offset by 2 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.161162 0.0224917 0.160622 0.162904
0.824859 0.0214695 0.811377 0.82987
3.75812 0.0211035 3.43031 3.75812
EOD
$d1 << EOD
0.240092 0.0116671 0.231422 0.264293
0.828203 0.00805651 0.81421 0.843801
2.43428 0.00629725 2.18246 2.50064
EOD
$d2 << EOD
0.219552 0.00403676 0.219242 0.220807
1.19602 0.0037862 1.1568 1.27001
4.59955 0.00362045 4.47682 4.59955
EOD
$d3 << EOD
0.225518 0.0114665 0.224721 0.226267
0.820397 0.00792018 0.820354 0.821564
2.23656 0.00632083 2.20359 2.34818
EOD
$d4 << EOD
1.34205 0.00866513 1.32082 1.35032
6.77809 0.0079846 6.77809 6.77809
29.4678 0.0077654 29.4678 29.4678
EOD
$d5 << EOD
1.29301 0.0305827 1.28509 1.30259
6.6049 0.0202304 6.6049 6.6049
25.6425 0.0146432 25.6425 25.6425
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.55
set rmargin at screen 0.7425
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'offset by -2 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.149272 0.0245298 0.147379 0.155623
0.764679 0.0217183 0.764014 0.767301
3.8971 0.0212373 3.42739 3.8971
EOD
$d1 << EOD
0.218643 0.0297989 0.217904 0.240604
0.788883 0.0192901 0.780642 0.807982
2.15208 0.0142757 2.13526 2.15825
EOD
$d2 << EOD
0.210361 0.00417929 0.209848 0.214249
1.1162 0.00386675 1.09651 1.12826
4.48473 0.00361431 4.35015 4.48473
EOD
$d3 << EOD
0.21425 0.0243619 0.21412 0.215255
0.778259 0.0154535 0.775905 0.811566
2.12897 0.0116497 2.11634 2.19536
EOD
$d4 << EOD
1.28853 0.00999863 1.28524 1.30706
6.56144 0.0100772 6.56144 6.56144
26.9717 0.0103694 26.9717 26.9717
EOD
$d5 << EOD
1.22718 0.0298531 1.22338 1.23012
6.72349 0.0198501 6.72349 6.72349
24.9803 0.0137466 24.9803 24.9803
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.7925
set rmargin at screen 0.985
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'offset by -8 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.144289 0.0281399 0.143813 0.147548
0.812645 0.025302 0.800252 0.816386
4.34014 0.0241588 4.33154 4.34014
EOD
$d1 << EOD
0.18638 0.0202636 0.184505 0.186549
0.722823 0.0132965 0.696579 0.743392
1.88458 0.0101514 1.87496 1.90969
EOD
$d2 << EOD
0.195259 0.00471716 0.194771 0.198455
1.12939 0.00412095 1.06851 1.14146
4.70291 0.00381782 4.58431 4.70291
EOD
$d3 << EOD
0.185567 0.0202734 0.185282 0.185625
0.738079 0.0131905 0.729508 0.744935
1.9599 0.00971993 1.93764 1.96592
EOD
$d4 << EOD
4.81136 0.0119969 4.71491 4.81136
25.7982 0.0119482 25.7982 25.7982
EOD
$d5 << EOD
4.37835 0.0325677 4.37513 4.37835
26.4049 0.0204185 26.4049 26.4049
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
set ylabel 'error [voxels]'
set lmargin at screen 0.065
set rmargin at screen 0.2575
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'union with a turned copy' font ',13' offset 0,-0.5
$d0 << EOD
0.303886 0.0233271 0.302234 0.307192
1.57613 0.0210277 1.56837 1.57691
7.38179 0.0204945 7.38179 7.38179
EOD
$d1 << EOD
0.453142 0.0214466 0.425624 0.453191
1.54885 0.0145297 1.54071 1.56283
3.93737 0.0105987 3.93586 3.93737
EOD
$d2 << EOD
0.409147 0.00382966 0.403779 0.430586
2.14399 0.00346822 2.13412 2.19425
8.96635 0.00331723 8.96635 8.96635
EOD
$d3 << EOD
0.427257 0.0214364 0.421246 0.441831
1.56248 0.0144709 1.53879 1.57689
4.10534 0.0106771 4.04421 4.10534
EOD
$d4 << EOD
0.658818 0.011049 0.652315 0.659297
3.48447 0.0105246 3.33241 3.48447
13.1793 0.0105621 13.1793 13.1793
EOD
$d5 << EOD
0.681415 0.0349884 0.680976 0.6818
3.71995 0.0232088 3.71044 3.71995
14.4314 0.0165365 14.4314 14.4314
EOD
$d6 << EOD
0.526465 0.0001 0.524054 0.536871
3.58161 0.0001 3.2884 3.58161
EOD
$d7 << EOD
0.838697 0.0001 0.835787 0.8433
4.23012 0.0001 4.16751 4.23012
EOD
$d8 << EOD
3.42418 0.0001 3.29365 3.42418
EOD
$d9 << EOD
4.63706 0.0001 3.50558 4.63706
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle, $d6 with xerrorlines lw 2 pt 9 ps 0.8 lc rgb '#009e73' notitle, $d7 with xerrorlines lw 1.2 dt 2 pt 8 ps 0.8 lc rgb '#009e73' notitle, $d8 with xerrorlines lw 2 pt 11 ps 0.8 lc rgb '#cc79a7' notitle, $d9 with xerrorlines lw 1.2 dt 2 pt 10 ps 0.8 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.3075
set rmargin at screen 0.5
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'resample to 1.3 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.150266 0.032209 0.149419 0.150283
0.825561 0.0288627 0.798871 0.874084
3.34871 0.0280777 3.29572 3.34871
EOD
$d1 << EOD
0.232348 0.0308006 0.231996 0.247848
0.87963 0.0204381 0.861222 0.881332
2.16878 0.014697 2.15522 2.17795
EOD
$d2 << EOD
0.240998 0.00618324 0.236712 0.244093
1.22696 0.00560565 1.22062 1.25387
4.90775 0.00532344 4.89425 4.90775
EOD
$d3 << EOD
0.233513 0.0307797 0.231379 0.236439
0.912237 0.0203572 0.907398 0.952498
2.26024 0.0147674 2.2573 2.27098
EOD
$d4 << EOD
1.27443 0.022933 1.27211 1.27603
6.37194 0.020793 6.37194 6.37194
24.8754 0.0201457 24.8754 24.8754
EOD
$d5 << EOD
1.36455 0.0603257 1.3437 1.37731
6.83162 0.0393201 6.83162 6.83162
27.1757 0.0277982 27.1757 27.1757
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.55
set rmargin at screen 0.7425
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'hollow, a wall of 8 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.152501 0.0254812 0.152259 0.152965
0.851351 0.0231379 0.840011 0.891143
4.08688 0.0272195 4.0473 4.08688
EOD
$d1 << EOD
0.192793 0.0190202 0.192558 0.193414
0.834584 0.0127287 0.816219 0.858067
2.64629 0.00928678 2.64327 2.64629
EOD
$d2 << EOD
0.231321 0.00423857 0.231006 0.232667
1.35356 0.00378645 1.313 1.43607
5.4539 0.00356877 5.4539 5.4539
EOD
$d3 << EOD
0.207896 0.0189166 0.203083 0.219878
0.846449 0.0125211 0.838025 0.875913
2.65882 0.00912654 2.65179 2.65882
EOD
$d4 << EOD
4.69185 0.0104918 4.67047 4.69185
25.2112 0.0104634 25.2112 25.2112
EOD
$d5 << EOD
4.50804 0.0303752 4.47562 4.50804
23.6149 0.0195458 23.6149 23.6149
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.7925
set rmargin at screen 0.985
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'to 10 % of the triangles' font ',13' offset 0,-0.5
$d0 << EOD
0.0873909 0.0249728 0.0738129 0.089776
0.516976 0.0249944 0.51155 0.538189
2.58511 0.0247081 2.52362 2.58511
EOD
$d1 << EOD
0.161693 0.00466928 0.160865 0.163529
0.538028 0.00327289 0.514008 0.554862
1.42547 0.00437177 1.42014 1.46805
EOD
$d2 << EOD
0.335518 0.0308263 0.307027 0.339448
2.66251 0.0288496 2.50301 2.66251
EOD
$d3 << EOD
2.45519 0.00826747 2.38516 2.45669
8.68969 0.00563735 8.68969 8.68969
EOD
$d4 << EOD
1.13716 0.0533057 0.982696 1.20916
5.16109 0.0468499 5.16109 5.16109
EOD
$d5 << EOD
2.26103 0.00816685 2.25584 2.29627
6.86351 0.00554049 6.86351 6.86351
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 9 ps 0.8 lc rgb '#009e73' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 8 ps 0.8 lc rgb '#009e73' notitle, $d4 with xerrorlines lw 2 pt 13 ps 0.8 lc rgb '#d55e00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 12 ps 0.8 lc rgb '#d55e00' notitle
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
plot [0:1][0:1] NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' title 'Argil', NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' title 'Argil, tolerance 0.01 voxels', NaN with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' title 'OpenVDB', NaN with linespoints lw 2 pt 9 ps 0.8 lc rgb '#009e73' title 'CGAL: wrap, corefinement, edge collapse', NaN with linespoints lw 2 pt 11 ps 0.8 lc rgb '#cc79a7' title 'Blender: voxel remesh, exact Boolean', NaN with linespoints lw 2 pt 13 ps 0.8 lc rgb '#d55e00' title 'OpenMesh quadrics', NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#808080' title 'wavy ball', NaN with linespoints lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#808080' title 'turned block'
unset multiplot
