# SPDX-License-Identifier: GPL-3.0-or-later
set terminal svg size 1180,1180 font 'Helvetica,13' background 'white'
set output 'force_failures.svg'
set datafile separator ';'
set multiplot layout 3,2
set grid lc '#dddddd'
set bmargin 7
set key below samplen 2 font ',11'
set linetype 1 lc '#1b6ca8' lw 2
set linetype 2 lc '#c0392b' lw 2
set linetype 3 lc '#e08e0b' lw 2
set linetype 4 lc '#2e8b57' lw 2
set linetype 5 lc '#7d3c98' lw 2
set linetype cycle 5
set title "A field that saturates one skin deep" font ',14'
set xlabel offset 0,0.6 'depth of the centre / R'
set ylabel 'force / f_{c0}'
plot 'force_failures.csv' index 0 using 3:4 with lines title "deep distance, R = skin", 'force_failures.csv' index 1 using 3:4 with lines title "saturating, R / skin = 1", 'force_failures.csv' index 2 using 3:4 with lines title "saturating, R / skin = 2", 'force_failures.csv' index 3 using 3:4 with lines title "saturating, R / skin = 5"
set title "A thin sheet is pushed through (skin R / 2)" font ',14'
set xlabel offset 0,0.6 'depth of the centre / R'
set ylabel 'force / f_{c0}'
plot 'force_failures.csv' index 4 using 3:4 with lines title "thickness / R = 2", 'force_failures.csv' index 5 using 3:4 with lines title "thickness / R = 1", 'force_failures.csv' index 6 using 3:4 with lines title "thickness / R = 0.5", 'force_failures.csv' index 7 using 3:4 with lines title "thickness / R = 0.25", 'force_failures.csv' index 8 using 3:4 with lines title "thickness / R = 0.1"
set title "Laws on averaged rough matter (8 voxels wide)" font ',14'
set xlabel offset 0,0.6 'height of the bumps / voxel'
set ylabel 'median error / %'
plot 'force_failures.csv' index 9 using 3:4 with lines title "unit gradients (blanch)", 'force_failures.csv' index 10 using 3:4 with lines title "energy"
set title "Sliding over flat clay, 8 nodes across" font ',14'
set xlabel offset 0,0.6 'path / voxel'
set ylabel 'force / mean - 1, %'
plot 'force_failures.csv' index 11 using 3:4 with lines title "sharp ball", 'force_failures.csv' index 12 using 3:4 with lines title "smooth kernel"
set title "Work gained on a closed path" font ',14'
set xlabel offset 0,0.6 'times round'
set ylabel 'work / mJ'
plot 'force_failures.csv' index 13 using 3:4 with lines title "unit gradients (blanch)", 'force_failures.csv' index 14 using 3:4 with lines title "energy"
unset multiplot
