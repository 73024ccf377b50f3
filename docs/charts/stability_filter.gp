# Made by 'argil chart stability'; run gnuplot on it in its folder.
set encoding utf8
set terminal svg noenhanced size 1100,860 font 'DejaVu Sans,12' background rgb 'white'
set output 'stability_filter.svg'
set grid lc rgb '#e4e4e4' lw 1
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set format x '%g'
set format y '%g'
set multiplot
set label 1 'The filtered position: stable stiffness against none' at screen 0.03,0.965 font ',16'
set label 2 'Ratio of the first limit cycle to that without a filter (tau = 1), on a grid of 10 %: red loses, blue gains. Contact law of exponent 4, 3 N, 1 kHz, one tick of delay.' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'
unset key
unset grid
set lmargin at screen 0.075
set rmargin at screen 0.4975
set tmargin at screen 0.855
set bmargin at screen 0.5175
set title 'push hand' font ',13' offset 0,-0.5
set ylabel 'lambda [mm]'
unset xlabel
set xtics ('0.01' 0,'0.018' 1,'0.03' 2,'0.05' 3,'0.1' 4,'0.2' 5,'0.3' 6,'0.5' 7,'0.75' 8,'1' 9)
set xrange [-0.5:9.5]
set ytics ('0.05' 0,'0.1' 1,'0.2' 2,'0.5' 3,'1' 4,'2' 5,'5' 6)
set yrange [-0.5:6.5]
$d0 << EOD
0 0 0.5 0.5 0xffffff
0 1 0.5 0.5 0xffffff
0 2 0.5 0.5 0xffffff
0 3 0.5 0.5 0xf9eeec
0 4 0.5 0.5 0xeccbc7
0 5 0.5 0.5 0xd68e86
0 6 0.5 0.5 0xb32e1f
1 0 0.5 0.5 0xffffff
1 1 0.5 0.5 0xfcf6f6
1 2 0.5 0.5 0xf9eeec
1 3 0.5 0.5 0xeccbc7
1 4 0.5 0.5 0xd68e86
1 5 0.5 0.5 0xc25a4e
1 6 0.5 0.5 0xb22d1e
2 0 0.5 0.5 0xfcf6f6
2 1 0.5 0.5 0xf9eeec
2 2 0.5 0.5 0xefd4d0
2 3 0.5 0.5 0xdc9f99
2 4 0.5 0.5 0xcc746a
2 5 0.5 0.5 0xbc483b
2 6 0.5 0.5 0xb22d1e
3 0 0.5 0.5 0xf9eeec
3 1 0.5 0.5 0xf2dcda
3 2 0.5 0.5 0xe9c2be
3 3 0.5 0.5 0xd68e86
3 4 0.5 0.5 0xc96b61
3 5 0.5 0.5 0xbf5145
3 6 0.5 0.5 0xb63729
4 0 0.5 0.5 0xf5e5e3
4 1 0.5 0.5 0xefd4d0
4 2 0.5 0.5 0xe6b9b4
4 3 0.5 0.5 0xd9978f
4 4 0.5 0.5 0xcf7d73
4 5 0.5 0.5 0xc96b61
4 6 0.5 0.5 0xc25a4e
5 0 0.5 0.5 0xf5e5e3
5 1 0.5 0.5 0xefd4d0
5 2 0.5 0.5 0xe9c2be
5 3 0.5 0.5 0xdfa8a2
5 4 0.5 0.5 0xd9978f
5 5 0.5 0.5 0xd68e86
5 6 0.5 0.5 0xd2857d
6 0 0.5 0.5 0xf9eeec
6 1 0.5 0.5 0xf2dcda
6 2 0.5 0.5 0xeccbc7
6 3 0.5 0.5 0xe6b9b4
6 4 0.5 0.5 0xe2b1ab
6 5 0.5 0.5 0xdfa8a2
6 6 0.5 0.5 0xdc9f99
7 0 0.5 0.5 0xf9eeec
7 1 0.5 0.5 0xf5e5e3
7 2 0.5 0.5 0xf2dcda
7 3 0.5 0.5 0xefd4d0
7 4 0.5 0.5 0xefd4d0
7 5 0.5 0.5 0xeccbc7
7 6 0.5 0.5 0xeccbc7
8 0 0.5 0.5 0xfcf6f6
8 1 0.5 0.5 0xfcf6f6
8 2 0.5 0.5 0xfcf6f6
8 3 0.5 0.5 0xf9eeec
8 4 0.5 0.5 0xf9eeec
8 5 0.5 0.5 0xf9eeec
8 6 0.5 0.5 0xf9eeec
9 0 0.5 0.5 0xffffff
9 1 0.5 0.5 0xffffff
9 2 0.5 0.5 0xffffff
9 3 0.5 0.5 0xffffff
9 4 0.5 0.5 0xffffff
9 5 0.5 0.5 0xffffff
9 6 0.5 0.5 0xffffff
EOD
$d1 << EOD
0 0 1.00
0 1 1.00
0 2 1.00
0 3 0.83
0 4 0.56
0 5 0.29
0 6 0.10
1 0 1.00
1 1 0.91
1 2 0.83
1 3 0.56
1 4 0.29
1 5 0.16
1 6 0.08
2 0 0.91
2 1 0.83
2 2 0.62
2 3 0.35
2 4 0.22
2 5 0.14
2 6 0.09
3 0 0.83
3 1 0.68
3 2 0.51
3 3 0.29
3 4 0.20
3 5 0.15
3 6 0.11
4 0 0.75
4 1 0.62
4 2 0.47
4 3 0.32
4 4 0.24
4 5 0.20
4 6 0.16
5 0 0.75
5 1 0.62
5 2 0.51
5 3 0.39
5 4 0.32
5 5 0.29
5 6 0.26
6 0 0.83
6 1 0.68
6 2 0.56
6 3 0.47
6 4 0.42
6 5 0.39
6 6 0.35
7 0 0.83
7 1 0.75
7 2 0.68
7 3 0.62
7 4 0.62
7 5 0.56
7 6 0.56
8 0 0.91
8 1 0.91
8 2 0.91
8 3 0.83
8 4 0.83
8 5 0.83
8 6 0.83
9 0 1.00
9 1 1.00
9 2 1.00
9 3 1.00
9 4 1.00
9 5 1.00
9 6 1.00
EOD
plot $d0 with boxxyerror fs solid noborder lc rgb variable notitle, $d1 with labels font ',10' notitle
unset label 1
unset label 2
set lmargin at screen 0.5575
set rmargin at screen 0.98
set tmargin at screen 0.855
set bmargin at screen 0.5175
set title 'light hand' font ',13' offset 0,-0.5
unset ylabel
unset xlabel
set xtics ('0.01' 0,'0.018' 1,'0.03' 2,'0.05' 3,'0.1' 4,'0.2' 5,'0.3' 6,'0.5' 7,'0.75' 8,'1' 9)
set xrange [-0.5:9.5]
set ytics ('0.05' 0,'0.1' 1,'0.2' 2,'0.5' 3,'1' 4,'2' 5,'5' 6)
set yrange [-0.5:6.5]
$d0 << EOD
0 0 0.5 0.5 0xffffff
0 1 0.5 0.5 0xffffff
0 2 0.5 0.5 0xffffff
0 3 0.5 0.5 0xf9eeec
0 4 0.5 0.5 0xeccbc7
0 5 0.5 0.5 0xd68e86
0 6 0.5 0.5 0xbc483b
1 0 0.5 0.5 0xfcf6f6
1 1 0.5 0.5 0xfcf6f6
1 2 0.5 0.5 0xf9eeec
1 3 0.5 0.5 0xe9c2be
1 4 0.5 0.5 0xd68e86
1 5 0.5 0.5 0xc25a4e
1 6 0.5 0.5 0xb22d1e
2 0 0.5 0.5 0xf9eeec
2 1 0.5 0.5 0xf5e5e3
2 2 0.5 0.5 0xefd4d0
2 3 0.5 0.5 0xd9978f
2 4 0.5 0.5 0xc96b61
2 5 0.5 0.5 0xbc483b
2 6 0.5 0.5 0xb22d1e
3 0 0.5 0.5 0xf5e5e3
3 1 0.5 0.5 0xefd4d0
3 2 0.5 0.5 0xe6b9b4
3 3 0.5 0.5 0xd2857d
3 4 0.5 0.5 0xc66357
3 5 0.5 0.5 0xbc483b
3 6 0.5 0.5 0xb32e1f
4 0 0.5 0.5 0xf2dcda
4 1 0.5 0.5 0xeccbc7
4 2 0.5 0.5 0xdfa8a2
4 3 0.5 0.5 0xd2857d
4 4 0.5 0.5 0xcc746a
4 5 0.5 0.5 0xc66357
4 6 0.5 0.5 0xbf5145
5 0 0.5 0.5 0xf2dcda
5 1 0.5 0.5 0xeccbc7
5 2 0.5 0.5 0xe6b9b4
5 3 0.5 0.5 0xdc9f99
5 4 0.5 0.5 0xd68e86
5 5 0.5 0.5 0xd2857d
5 6 0.5 0.5 0xcf7d73
6 0 0.5 0.5 0xf2dcda
6 1 0.5 0.5 0xefd4d0
6 2 0.5 0.5 0xe9c2be
6 3 0.5 0.5 0xe2b1ab
6 4 0.5 0.5 0xdfa8a2
6 5 0.5 0.5 0xdc9f99
6 6 0.5 0.5 0xdc9f99
7 0 0.5 0.5 0xf5e5e3
7 1 0.5 0.5 0xf2dcda
7 2 0.5 0.5 0xefd4d0
7 3 0.5 0.5 0xeccbc7
7 4 0.5 0.5 0xeccbc7
7 5 0.5 0.5 0xeccbc7
7 6 0.5 0.5 0xe9c2be
8 0 0.5 0.5 0xf9eeec
8 1 0.5 0.5 0xf9eeec
8 2 0.5 0.5 0xf9eeec
8 3 0.5 0.5 0xf5e5e3
8 4 0.5 0.5 0xf5e5e3
8 5 0.5 0.5 0xf5e5e3
8 6 0.5 0.5 0xf5e5e3
9 0 0.5 0.5 0xffffff
9 1 0.5 0.5 0xffffff
9 2 0.5 0.5 0xffffff
9 3 0.5 0.5 0xffffff
9 4 0.5 0.5 0xffffff
9 5 0.5 0.5 0xffffff
9 6 0.5 0.5 0xffffff
EOD
$d1 << EOD
0 0 1.00
0 1 1.00
0 2 1.00
0 3 0.83
0 4 0.56
0 5 0.29
0 6 0.14
1 0 0.91
1 1 0.91
1 2 0.83
1 3 0.51
1 4 0.29
1 5 0.16
1 6 0.09
2 0 0.83
2 1 0.75
2 2 0.62
2 3 0.32
2 4 0.20
2 5 0.14
2 6 0.09
3 0 0.75
3 1 0.62
3 2 0.47
3 3 0.26
3 4 0.18
3 5 0.14
3 6 0.10
4 0 0.68
4 1 0.56
4 2 0.39
4 3 0.26
4 4 0.22
4 5 0.18
4 6 0.15
5 0 0.68
5 1 0.56
5 2 0.47
5 3 0.35
5 4 0.29
5 5 0.26
5 6 0.24
6 0 0.68
6 1 0.62
6 2 0.51
6 3 0.42
6 4 0.39
6 5 0.35
6 6 0.35
7 0 0.75
7 1 0.68
7 2 0.62
7 3 0.56
7 4 0.56
7 5 0.56
7 6 0.51
8 0 0.83
8 1 0.83
8 2 0.83
8 3 0.75
8 4 0.75
8 5 0.75
8 6 0.75
9 0 1.00
9 1 1.00
9 2 1.00
9 3 1.00
9 4 1.00
9 5 1.00
9 6 1.00
EOD
plot $d0 with boxxyerror fs solid noborder lc rgb variable notitle, $d1 with labels font ',10' notitle
set lmargin at screen 0.075
set rmargin at screen 0.4975
set tmargin at screen 0.4175
set bmargin at screen 0.08
set title 'arm hand' font ',13' offset 0,-0.5
set ylabel 'lambda [mm]'
set xlabel 'tau per ms'
set xtics ('0.01' 0,'0.018' 1,'0.03' 2,'0.05' 3,'0.1' 4,'0.2' 5,'0.3' 6,'0.5' 7,'0.75' 8,'1' 9)
set xrange [-0.5:9.5]
set ytics ('0.05' 0,'0.1' 1,'0.2' 2,'0.5' 3,'1' 4,'2' 5,'5' 6)
set yrange [-0.5:6.5]
$d0 << EOD
0 0 0.5 0.5 0xf6f9fd
0 1 0.5 0.5 0xffffff
0 2 0.5 0.5 0xffffff
0 3 0.5 0.5 0xefd4d0
0 4 0.5 0.5 0xd9978f
0 5 0.5 0.5 0xc66357
0 6 0.5 0.5 0xb22d1e
1 0 0.5 0.5 0xffffff
1 1 0.5 0.5 0xf9eeec
1 2 0.5 0.5 0xf2dcda
1 3 0.5 0.5 0xd9978f
1 4 0.5 0.5 0xc66357
1 5 0.5 0.5 0xb63729
1 6 0.5 0.5 0xb22d1e
2 0 0.5 0.5 0xf9eeec
2 1 0.5 0.5 0xf2dcda
2 2 0.5 0.5 0xe2b1ab
2 3 0.5 0.5 0xcc746a
2 4 0.5 0.5 0xbf5145
2 5 0.5 0.5 0xb32e1f
2 6 0.5 0.5 0xb22d1e
3 0 0.5 0.5 0xf2dcda
3 1 0.5 0.5 0xe9c2be
3 2 0.5 0.5 0xdc9f99
3 3 0.5 0.5 0xc96b61
3 4 0.5 0.5 0xbf5145
3 5 0.5 0.5 0xb63729
3 6 0.5 0.5 0xb22d1e
4 0 0.5 0.5 0xefd4d0
4 1 0.5 0.5 0xe6b9b4
4 2 0.5 0.5 0xdc9f99
4 3 0.5 0.5 0xcf7d73
4 4 0.5 0.5 0xc96b61
4 5 0.5 0.5 0xc25a4e
4 6 0.5 0.5 0xbc483b
5 0 0.5 0.5 0xefd4d0
5 1 0.5 0.5 0xe9c2be
5 2 0.5 0.5 0xe2b1ab
5 3 0.5 0.5 0xd9978f
5 4 0.5 0.5 0xd68e86
5 5 0.5 0.5 0xd2857d
5 6 0.5 0.5 0xd2857d
6 0 0.5 0.5 0xf2dcda
6 1 0.5 0.5 0xeccbc7
6 2 0.5 0.5 0xe9c2be
6 3 0.5 0.5 0xe2b1ab
6 4 0.5 0.5 0xdfa8a2
6 5 0.5 0.5 0xdfa8a2
6 6 0.5 0.5 0xdc9f99
7 0 0.5 0.5 0xf9eeec
7 1 0.5 0.5 0xf5e5e3
7 2 0.5 0.5 0xf2dcda
7 3 0.5 0.5 0xefd4d0
7 4 0.5 0.5 0xefd4d0
7 5 0.5 0.5 0xeccbc7
7 6 0.5 0.5 0xeccbc7
8 0 0.5 0.5 0xfcf6f6
8 1 0.5 0.5 0xfcf6f6
8 2 0.5 0.5 0xf9eeec
8 3 0.5 0.5 0xf9eeec
8 4 0.5 0.5 0xf9eeec
8 5 0.5 0.5 0xf9eeec
8 6 0.5 0.5 0xf9eeec
9 0 0.5 0.5 0xffffff
9 1 0.5 0.5 0xffffff
9 2 0.5 0.5 0xffffff
9 3 0.5 0.5 0xffffff
9 4 0.5 0.5 0xffffff
9 5 0.5 0.5 0xffffff
9 6 0.5 0.5 0xffffff
EOD
$d1 << EOD
0 0 1.10
0 1 1.00
0 2 1.00
0 3 0.62
0 4 0.32
0 5 0.18
0 6 0.09
1 0 1.00
1 1 0.83
1 2 0.68
1 3 0.32
1 4 0.18
1 5 0.11
1 6 0.07
2 0 0.83
2 1 0.68
2 2 0.42
2 3 0.22
2 4 0.15
2 5 0.10
2 6 0.08
3 0 0.68
3 1 0.51
3 2 0.35
3 3 0.20
3 4 0.15
3 5 0.11
3 6 0.09
4 0 0.62
4 1 0.47
4 2 0.35
4 3 0.24
4 4 0.20
4 5 0.16
4 6 0.14
5 0 0.62
5 1 0.51
5 2 0.42
5 3 0.32
5 4 0.29
5 5 0.26
5 6 0.26
6 0 0.68
6 1 0.56
6 2 0.51
6 3 0.42
6 4 0.39
6 5 0.39
6 6 0.35
7 0 0.83
7 1 0.75
7 2 0.68
7 3 0.62
7 4 0.62
7 5 0.56
7 6 0.56
8 0 0.91
8 1 0.91
8 2 0.83
8 3 0.83
8 4 0.83
8 5 0.83
8 6 0.83
9 0 1.00
9 1 1.00
9 2 1.00
9 3 1.00
9 4 1.00
9 5 1.00
9 6 1.00
EOD
plot $d0 with boxxyerror fs solid noborder lc rgb variable notitle, $d1 with labels font ',10' notitle
set lmargin at screen 0.5575
set rmargin at screen 0.98
set tmargin at screen 0.4175
set bmargin at screen 0.08
set title 'firm hand' font ',13' offset 0,-0.5
unset ylabel
set xlabel 'tau per ms'
set xtics ('0.01' 0,'0.018' 1,'0.03' 2,'0.05' 3,'0.1' 4,'0.2' 5,'0.3' 6,'0.5' 7,'0.75' 8,'1' 9)
set xrange [-0.5:9.5]
set ytics ('0.05' 0,'0.1' 1,'0.2' 2,'0.5' 3,'1' 4,'2' 5,'5' 6)
set yrange [-0.5:6.5]
$d0 << EOD
0 0 0.5 0.5 0xecf2fa
0 1 0.5 0.5 0xe3ecf8
0 2 0.5 0.5 0xdae5f6
0 3 0.5 0.5 0xdae5f6
0 4 0.5 0.5 0xf5e5e3
0 5 0.5 0.5 0xe6b9b4
0 6 0.5 0.5 0xd68e86
1 0 0.5 0.5 0xf6f9fd
1 1 0.5 0.5 0xf6f9fd
1 2 0.5 0.5 0xf6f9fd
1 3 0.5 0.5 0xefd4d0
1 4 0.5 0.5 0xdfa8a2
1 5 0.5 0.5 0xd2857d
1 6 0.5 0.5 0xc66357
2 0 0.5 0.5 0xffffff
2 1 0.5 0.5 0xfcf6f6
2 2 0.5 0.5 0xf2dcda
2 3 0.5 0.5 0xdfa8a2
2 4 0.5 0.5 0xd2857d
2 5 0.5 0.5 0xc96b61
2 6 0.5 0.5 0xbf5145
3 0 0.5 0.5 0xf9eeec
3 1 0.5 0.5 0xefd4d0
3 2 0.5 0.5 0xe6b9b4
3 3 0.5 0.5 0xd68e86
3 4 0.5 0.5 0xcc746a
3 5 0.5 0.5 0xc66357
3 6 0.5 0.5 0xbf5145
4 0 0.5 0.5 0xefd4d0
4 1 0.5 0.5 0xe6b9b4
4 2 0.5 0.5 0xdfa8a2
4 3 0.5 0.5 0xd68e86
4 4 0.5 0.5 0xcf7d73
4 5 0.5 0.5 0xc96b61
4 6 0.5 0.5 0xc66357
5 0 0.5 0.5 0xefd4d0
5 1 0.5 0.5 0xe9c2be
5 2 0.5 0.5 0xe2b1ab
5 3 0.5 0.5 0xdc9f99
5 4 0.5 0.5 0xd9978f
5 5 0.5 0.5 0xd9978f
5 6 0.5 0.5 0xd68e86
6 0 0.5 0.5 0xf2dcda
6 1 0.5 0.5 0xeccbc7
6 2 0.5 0.5 0xe9c2be
6 3 0.5 0.5 0xe6b9b4
6 4 0.5 0.5 0xe2b1ab
6 5 0.5 0.5 0xe2b1ab
6 6 0.5 0.5 0xdfa8a2
7 0 0.5 0.5 0xf5e5e3
7 1 0.5 0.5 0xf2dcda
7 2 0.5 0.5 0xf2dcda
7 3 0.5 0.5 0xefd4d0
7 4 0.5 0.5 0xefd4d0
7 5 0.5 0.5 0xefd4d0
7 6 0.5 0.5 0xefd4d0
8 0 0.5 0.5 0xfcf6f6
8 1 0.5 0.5 0xfcf6f6
8 2 0.5 0.5 0xf9eeec
8 3 0.5 0.5 0xf9eeec
8 4 0.5 0.5 0xf9eeec
8 5 0.5 0.5 0xf9eeec
8 6 0.5 0.5 0xf9eeec
9 0 0.5 0.5 0xffffff
9 1 0.5 0.5 0xffffff
9 2 0.5 0.5 0xffffff
9 3 0.5 0.5 0xffffff
9 4 0.5 0.5 0xffffff
9 5 0.5 0.5 0xffffff
9 6 0.5 0.5 0xffffff
EOD
$d1 << EOD
0 0 1.21
0 1 1.33
0 2 1.46
0 3 1.46
0 4 0.75
0 5 0.47
0 6 0.29
1 0 1.10
1 1 1.10
1 2 1.10
1 3 0.62
1 4 0.39
1 5 0.26
1 6 0.18
2 0 1.00
2 1 0.91
2 2 0.68
2 3 0.39
2 4 0.26
2 5 0.20
2 6 0.15
3 0 0.83
3 1 0.62
3 2 0.47
3 3 0.29
3 4 0.22
3 5 0.18
3 6 0.15
4 0 0.62
4 1 0.47
4 2 0.39
4 3 0.29
4 4 0.24
4 5 0.20
4 6 0.18
5 0 0.62
5 1 0.51
5 2 0.42
5 3 0.35
5 4 0.32
5 5 0.32
5 6 0.29
6 0 0.68
6 1 0.56
6 2 0.51
6 3 0.47
6 4 0.42
6 5 0.42
6 6 0.39
7 0 0.75
7 1 0.68
7 2 0.68
7 3 0.62
7 4 0.62
7 5 0.62
7 6 0.62
8 0 0.91
8 1 0.91
8 2 0.83
8 3 0.83
8 4 0.83
8 5 0.83
8 6 0.83
9 0 1.00
9 1 1.00
9 2 1.00
9 3 1.00
9 4 1.00
9 5 1.00
9 6 1.00
EOD
plot $d0 with boxxyerror fs solid noborder lc rgb variable notitle, $d1 with labels font ',10' notitle
unset multiplot
