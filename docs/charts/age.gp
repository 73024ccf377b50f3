# gnuplot age.gp: draws age.csv and age_before.csv, which bench_age writes, as age.svg.
set datafile separator ','
set terminal svg size 1100,560 font 'Arial,13' background '#ffffff'
set output 'age.svg'
set key left top samplen 2 spacing 1.2
set grid lc '#dddddd'
set border lc '#666666'
set logscale x
set xrange [1:500]
set yrange [0:100]
set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500)
set xlabel 'age of the clay that is felt, ms'
set ylabel '% of ticks that feel clay no older'
set label 1 'How old the clay is that a hand feels while it carves' at screen 0.08,0.955 font 'Arial,17'
set label 2 'Carving at 50 mm/s around a ball of 2 M vertices, dabs and windows on one thread; dashed: windows by fast marching, with a margin of 4 mm' at screen 0.08,0.905 tc '#555555'
set tmargin at screen 0.86
plot for [r in '1 4 16'] 'age_before.csv' using ($1 == r ? $3 : NaN):2 with lines dt 2 lw 2 \
       lc rgb (r eq '1' ? '#0072b2' : r eq '4' ? '#d55e00' : '#009e73') title 'R = '.r.' mm, before', \
     for [r in '1 4 16'] 'age.csv' using ($1 == r ? $3 : NaN):2 with lines lw 2.5 \
       lc rgb (r eq '1' ? '#0072b2' : r eq '4' ? '#d55e00' : '#009e73') title 'R = '.r.' mm, now'
