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
set label 2 'Bodies of 0.1, 0.5, 2 and 8 million vertices, a mark each from left to right; down and left is better. Error: rms in finest voxels from the exact result, 1e-4 and less as one.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
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
0.631659 0.0230908 0.628005 0.65819
2.92732 0.0208315 2.90195 2.92732
12.4564 0.020007 12.4564 12.4564
47.2804 0.0199155 47.2804 47.2804
EOD
$d1 << EOD
0.761859 0.0187295 0.751927 0.782586
3.75605 0.012742 3.62253 3.75605
15.088 0.00967307 15.088 15.088
60.4717 0.00798993 60.4717 60.4717
EOD
$d2 << EOD
0.634511 0.00381317 0.624921 0.63592
2.88528 0.0034527 2.86452 2.88528
12.1792 0.00330759 12.1792 12.1792
47.8767 0.00330205 47.8767 47.8767
EOD
$d3 << EOD
0.731495 0.0187196 0.728055 0.731775
4.10601 0.0128452 3.65491 4.10601
14.8653 0.0101354 14.8653 14.8653
60.0355 0.0102134 60.0355 60.0355
EOD
$d4 << EOD
1.27379 0.00913764 1.26766 1.27518
6.23333 0.00895671 6.23333 6.23333
25.1812 0.0090687 25.1812 25.1812
96.3675 0.00925964 96.3675 96.3675
EOD
$d5 << EOD
1.28236 0.0274847 1.27502 1.29004
6.41311 0.0175696 6.41311 6.41311
24.7871 0.0128561 24.7871 24.7871
94.2622 0.00936014 94.2622 94.2622
EOD
$d6 << EOD
33.4532 0.0325543 33.4532 33.4532
EOD
$d7 << EOD
19.9025 0.0332595 19.9025 19.9025
EOD
$d8 << EOD
1.32754 0.00331384 1.31687 1.56704
6.95521 0.00304264 6.95521 6.95521
29.6887 0.00291409 29.6887 29.6887
EOD
$d9 << EOD
1.35361 0.00992437 1.34989 1.35806
7.57366 0.0064082 7.57366 7.57366
30.7639 0.00434432 30.7639 30.7639
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
0.124041 0.0224917 0.121132 0.129966
0.586274 0.0214695 0.567634 0.590742
2.42495 0.0211035 2.40703 2.5227
9.22482 0.0210725 9.22482 9.22482
EOD
$d1 << EOD
0.171167 0.011602 0.170639 0.173339
0.59562 0.00799464 0.592993 0.5969
1.50941 0.00624964 1.48267 1.51675
3.29606 0.0055062 3.29291 3.29606
EOD
$d2 << EOD
0.159332 0.00403676 0.158647 0.162771
0.757577 0.0037862 0.753723 0.765734
3.32386 0.00362045 3.31407 3.32386
13.0759 0.0035776 13.0759 13.0759
EOD
$d3 << EOD
0.164626 0.0114002 0.163283 0.166396
0.668759 0.00784882 0.667467 0.673597
1.48789 0.00620026 1.4844 1.49597
3.38922 0.00507599 3.38447 3.38922
EOD
$d4 << EOD
1.13561 0.00866513 1.13478 1.13961
5.66 0.0079846 5.66 5.66
23.6454 0.0077654 23.6454 23.6454
88.2437 0.0078233 88.2437 88.2437
EOD
$d5 << EOD
1.12383 0.0305827 1.10634 1.16718
5.6524 0.0202304 5.6524 5.6524
22.0265 0.0146432 22.0265 22.0265
84.441 0.0101932 84.441 84.441
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.55
set rmargin at screen 0.7425
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'offset by -2 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.129301 0.0245298 0.121656 0.132871
0.555743 0.0217183 0.553091 0.558531
2.4062 0.0212373 2.39857 2.4164
9.1294 0.0212081 9.1294 9.1294
EOD
$d1 << EOD
0.182732 0.0296481 0.181946 0.18607
0.63507 0.0193426 0.628501 0.639249
1.56315 0.014328 1.54315 1.56489
3.46849 0.010746 3.46276 3.46849
EOD
$d2 << EOD
0.151126 0.00417929 0.150751 0.153938
0.771182 0.00386675 0.759953 0.782882
3.37359 0.00361431 3.35278 3.37359
13.9818 0.00360338 13.9818 13.9818
EOD
$d3 << EOD
0.174741 0.0242155 0.17443 0.175354
0.647432 0.0153217 0.637756 0.673428
1.54542 0.0117465 1.52701 1.55827
3.60494 0.00911384 3.58816 3.60494
EOD
$d4 << EOD
1.09879 0.00999863 1.09703 1.1051
5.51745 0.0100772 5.51745 5.51745
22.7718 0.0103694 22.7718 22.7718
88.3513 0.0106441 88.3513 88.3513
EOD
$d5 << EOD
1.08214 0.0298531 1.05808 1.08937
5.54541 0.0198501 5.54541 5.54541
21.5738 0.0137466 21.5738 21.5738
84.3437 0.00939774 84.3437 84.3437
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.7925
set rmargin at screen 0.985
set tmargin at screen 0.865
set bmargin at screen 0.5775
set title 'offset by -8 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.102232 0.0281397 0.100724 0.102884
0.525472 0.025302 0.52009 0.529694
2.33661 0.0241588 2.3338 2.37894
9.35034 0.0241621 9.35034 9.35034
EOD
$d1 << EOD
0.158314 0.0201049 0.158236 0.159606
0.595104 0.0132088 0.57678 0.633865
1.46866 0.0101312 1.44484 1.48309
3.58048 0.00724191 3.28313 3.58048
EOD
$d2 << EOD
0.148132 0.00471716 0.146686 0.150474
0.798009 0.00412095 0.794989 0.80899
3.61958 0.00381782 3.6001 3.61958
14.2155 0.0037942 14.2155 14.2155
EOD
$d3 << EOD
0.160191 0.0201126 0.159451 0.163079
0.619426 0.013199 0.596652 0.639754
1.50426 0.0100145 1.4969 1.50733
3.42903 0.00698923 3.42084 3.42903
EOD
$d4 << EOD
4.07912 0.0119969 4.06861 4.07912
21.6619 0.0119482 21.6619 21.6619
EOD
$d5 << EOD
3.87226 0.0325677 3.842 3.87226
20.8966 0.0204185 20.8966 20.8966
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
set ylabel 'error [voxels]'
set lmargin at screen 0.065
set rmargin at screen 0.2575
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'union with a turned copy' font ',13' offset 0,-0.5
$d0 << EOD
0.273422 0.0233271 0.272925 0.274416
1.40237 0.0210277 1.37777 1.4065
5.71264 0.0204945 5.71264 5.71264
22.9054 0.0203075 22.9054 22.9054
EOD
$d1 << EOD
0.367136 0.0214466 0.366605 0.3686
1.2993 0.0145297 1.289 1.30147
3.3027 0.0105987 3.29622 3.3027
7.34295 0.00930371 7.34295 7.34295
EOD
$d2 << EOD
0.348002 0.00382966 0.344491 0.357183
1.72893 0.00346822 1.64802 1.78274
7.92412 0.00331723 7.92412 7.92412
31.2767 0.00330592 31.2767 31.2767
EOD
$d3 << EOD
0.362511 0.0214364 0.359115 0.363096
1.4523 0.0144709 1.44734 1.47085
3.37235 0.0106771 3.25992 3.37235
7.47979 0.0102538 7.47979 7.47979
EOD
$d4 << EOD
0.549466 0.011049 0.549305 0.5528
2.85345 0.0105246 2.83369 2.85345
11.4543 0.0105621 11.4543 11.4543
43.3961 0.010724 43.3961 43.3961
EOD
$d5 << EOD
0.583776 0.0349884 0.583172 0.594956
2.99814 0.0232088 2.98123 2.99814
11.5201 0.0165365 11.5201 11.5201
45.413 0.0115005 45.413 45.413
EOD
$d6 << EOD
0.542488 0.0001 0.542358 0.543389
3.47275 0.0001 3.32963 3.47275
EOD
$d7 << EOD
0.818265 0.0001 0.81745 0.826383
4.65569 0.0001 4.43946 4.65569
EOD
$d8 << EOD
4.91226 0.0001 3.27709 4.91226
EOD
$d9 << EOD
3.38147 0.0001 3.25957 3.38147
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle, $d6 with xerrorlines lw 2 pt 9 ps 0.8 lc rgb '#009e73' notitle, $d7 with xerrorlines lw 1.2 dt 2 pt 8 ps 0.8 lc rgb '#009e73' notitle, $d8 with xerrorlines lw 2 pt 11 ps 0.8 lc rgb '#cc79a7' notitle, $d9 with xerrorlines lw 1.2 dt 2 pt 10 ps 0.8 lc rgb '#cc79a7' notitle
unset ylabel
set lmargin at screen 0.3075
set rmargin at screen 0.5
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'resample to 1.3 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.11845 0.032209 0.117222 0.119462
0.602943 0.0288627 0.598754 0.606786
2.56302 0.0280777 2.54076 2.56302
9.94256 0.0275739 9.94256 9.94256
EOD
$d1 << EOD
0.172702 0.0308008 0.172004 0.174437
0.62328 0.0204381 0.620879 0.624452
1.5793 0.0146971 1.54752 1.59298
3.45661 0.0109411 3.45377 3.45661
EOD
$d2 << EOD
0.175723 0.00618324 0.173451 0.176323
0.914702 0.00560565 0.901623 0.920901
3.95731 0.00532344 3.84962 3.95731
14.8967 0.00530199 14.8967 14.8967
EOD
$d3 << EOD
0.17698 0.0307799 0.174732 0.177843
0.69772 0.0203572 0.680257 0.703015
1.61269 0.0147674 1.60499 1.62779
3.52944 0.0110217 3.50315 3.52944
EOD
$d4 << EOD
1.11946 0.022933 1.10874 1.12351
5.56108 0.020793 5.56108 5.56108
21.7407 0.0201457 21.7407 21.7407
83.6397 0.0201718 83.6397 83.6397
EOD
$d5 << EOD
1.17303 0.0603257 1.17023 1.18135
5.98548 0.0393201 5.98548 5.98548
22.8504 0.0277982 22.8504 22.8504
90.096 0.0201226 90.096 90.096
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.55
set rmargin at screen 0.7425
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'hollow, a wall of 8 voxels' font ',13' offset 0,-0.5
$d0 << EOD
0.109064 0.0253749 0.108382 0.111174
0.601669 0.0231422 0.598289 0.606829
2.73455 0.027356 2.69749 2.73455
10.9013 0.0222376 10.9013 10.9013
EOD
$d1 << EOD
0.205404 0.0282076 0.204524 0.205409
0.790461 0.0187177 0.775664 0.794936
2.20375 0.0130541 2.18168 2.20749
6.75393 0.00956445 6.75393 6.75393
EOD
$d2 << EOD
0.168925 0.00424403 0.167187 0.174002
1.03754 0.00378861 1.03458 1.04753
4.91272 0.0035778 4.86986 4.91272
19.517 0.00355409 19.517 19.517
EOD
$d3 << EOD
0.216141 0.0283135 0.211078 0.218178
0.836814 0.0183239 0.834226 0.856284
2.31765 0.0129932 2.27126 2.35548
6.9731 0.00954849 6.9731 6.9731
EOD
$d4 << EOD
4.05912 0.0104918 4.03231 4.05912
21.1736 0.0104634 21.1736 21.1736
EOD
$d5 << EOD
3.84669 0.0303752 3.75362 3.84669
20.8796 0.0195458 20.8796 20.8796
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#56b4e9' notitle, $d4 with xerrorlines lw 2 pt 5 ps 0.8 lc rgb '#e69f00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 4 ps 0.8 lc rgb '#e69f00' notitle
unset ylabel
set lmargin at screen 0.7925
set rmargin at screen 0.985
set tmargin at screen 0.4525
set bmargin at screen 0.165
set title 'to 10 % of the triangles' font ',13' offset 0,-0.5
$d0 << EOD
0.0611401 0.0249333 0.0599379 0.0633168
0.369234 0.0249923 0.362993 0.373469
1.9191 0.0246697 1.84499 1.92668
9.86623 0.0248589 9.86623 9.86623
EOD
$d1 << EOD
0.1349 0.00459505 0.134419 0.136569
0.405624 0.00340698 0.404005 0.414908
0.883153 0.00449564 0.871361 0.899926
2.59838 0.00353966 2.59825 2.59838
EOD
$d2 << EOD
0.2544 0.0308117 0.25307 0.25734
2.20797 0.0290149 2.18235 2.22956
EOD
$d3 << EOD
2.28812 0.0079399 2.25671 2.35816
8.5694 0.0055435 8.5694 8.5694
EOD
$d4 << EOD
0.737547 0.0533322 0.736793 0.742475
4.41162 0.0468906 4.37754 4.41162
EOD
$d5 << EOD
1.97026 0.00784327 1.96355 1.98155
5.75742 0.00548895 5.75742 5.75742
EOD
$d6 << EOD
0.0138337 0.0536352 0.0135218 0.0147574
0.0888951 0.0565153 0.0855427 0.0957555
0.483686 0.0788778 0.478216 0.487096
2.71392 0.118801 2.62641 2.71392
EOD
$d7 << EOD
0.0351 0.00979137 0.03507 0.0364192
0.122474 0.0101807 0.120351 0.127952
0.296658 0.0145947 0.296129 0.299986
0.773798 0.0248446 0.763789 0.775792
EOD
plot $d0 with xerrorlines lw 2 pt 7 ps 0.8 lc rgb '#0072b2' notitle, $d1 with xerrorlines lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#0072b2' notitle, $d2 with xerrorlines lw 2 pt 9 ps 0.8 lc rgb '#009e73' notitle, $d3 with xerrorlines lw 1.2 dt 2 pt 8 ps 0.8 lc rgb '#009e73' notitle, $d4 with xerrorlines lw 2 pt 13 ps 0.8 lc rgb '#d55e00' notitle, $d5 with xerrorlines lw 1.2 dt 2 pt 12 ps 0.8 lc rgb '#d55e00' notitle, $d6 with xerrorlines lw 2 pt 3 ps 0.8 lc rgb '#000000' notitle, $d7 with xerrorlines lw 1.2 dt 2 pt 2 ps 0.8 lc rgb '#000000' notitle
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
plot [0:1][0:1] NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#0072b2' title 'Argil', NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#56b4e9' title 'Argil, tolerance 0.01 voxels', NaN with linespoints lw 2 pt 5 ps 0.8 lc rgb '#e69f00' title 'OpenVDB', NaN with linespoints lw 2 pt 9 ps 0.8 lc rgb '#009e73' title 'CGAL: wrap, corefinement, edge collapse', NaN with linespoints lw 2 pt 11 ps 0.8 lc rgb '#cc79a7' title 'Blender: voxel remesh, exact Boolean', NaN with linespoints lw 2 pt 13 ps 0.8 lc rgb '#d55e00' title 'OpenMesh quadrics', NaN with linespoints lw 2 pt 3 ps 0.8 lc rgb '#000000' title 'meshoptimizer', NaN with linespoints lw 2 pt 7 ps 0.8 lc rgb '#808080' title 'wavy ball', NaN with linespoints lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#808080' title 'turned block'
unset multiplot
