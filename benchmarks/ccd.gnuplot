# SPDX-License-Identifier: Zlib
# Errors against time of the collision checks: gnuplot -e "data='ccd.csv'; picture='ccd.svg'" ccd.gnuplot
set datafile separator ';'
set terminal svg size 1000,640 font 'sans,13' background '#ffffff'
set output picture
set logscale x
set xrange [20:1000]
set format x '%g'
set grid
set xtics (20, 50, 100, 200, 500, 1000)

# Methods by colour, types of query by symbol
array methods[8] = ['fast, in batches of 256', 'conservative', 'exact', 'Bullet''s own, float64', 'textbook, strict', \
                    'textbook, 1e-6', 'textbook, float, 1e-6', 'Newton, 1e-6']
array colours[8] = [0x2e8b57, 0x0b6fb8, 0x102a63, 0xd62728, 0xe08b00, 0xf0b429, 0xb0a080, 0x8e6bbf]
array collections[2] = ['real', 'cloth']

set multiplot
do for [row=0:1] {
  top = row == 0 ? 0.93 : 0.44
  do for [column=1:2] {
    set lmargin at screen column == 1 ? 0.075 : 0.43
    set rmargin at screen column == 1 ? 0.38 : 0.735
    set tmargin at screen top
    set bmargin at screen top - 0.33
    set title sprintf('%s, %s queries', row == 0 ? 'contacts missed' : 'false alarms', collections[column])
    if (row == 1) { set xlabel 'mean time per query [ns]' } else { unset xlabel }
    errors = row == 0 ? 3 : 4
    if (row == 0) { set yrange [-4:64] } else { set yrange [-9:144] }
    show = row == 0 && column == 2
    if (show) { set key at screen 0.99, screen 0.93 right top } else { unset key }
    plot for [i=1:8] data skip 1 \
           using (strcol(1) eq methods[i] && strcol(2) eq collections[column] . ' vf' ? $5 : NaN):errors \
           with points pointtype 7 pointsize 1 linecolor rgb colours[i] title show ? methods[i] : '', \
         for [i=1:8] data skip 1 \
           using (strcol(1) eq methods[i] && strcol(2) eq collections[column] . ' ee' ? $5 : NaN):errors \
           with points pointtype 5 pointsize 0.8 linecolor rgb colours[i] notitle, \
         NaN with points pointtype 7 linecolor rgb '#555555' title show ? 'vertex-face' : '', \
         NaN with points pointtype 5 linecolor rgb '#555555' title show ? 'edge-edge' : ''
  }
}
unset multiplot
