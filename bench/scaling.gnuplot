# scaling.svg and scaling.png of `brume bench --scaling`. brume puts before it: plot_title, n_axes, svg_file, png_file and
# the data block $axes (an index per axis: its name with its exponent, then lines "value seconds", both over those of the
# first point).
set logscale xy 2
set format "%g"
set xlabel "times as much is asked for"
set ylabel "times as long it takes"
set title plot_title noenhanced
set key outside right top Left reverse noenhanced
set grid lc rgb "#dddddd" lt 1
set border lc rgb "#111111"
array colors[8] = [0x000000, 0x0b5394, 0xd9822b, 0x8fbc5a, 0x7b1fa2, 0xc2185b, 0x4db6ac, 0x5d4037]
array shapes[8] = [12, 4, 8, 10, 6, 14, 1, 2]
set xrange [1:*]
draw = 'plot for [power=1:2] [x=1:32] x**power with lines dt 3 lc rgb "#999999" title sprintf("to the power %d", power), \
  for [i=1:n_axes] $axes index i-1 using 1:2 with linespoints pt shapes[(i-1)%8+1] lw 1.6 lc rgb colors[(i-1)%8+1] \
  title columnheader(1)'
set terminal svg size 1000, 640 font "sans-serif,13" background "#ffffff"
set output svg_file
eval draw
set terminal pngcairo size 1500, 960 font "sans-serif,14" linewidth 1.5 pointscale 1.4
set output png_file
eval draw
set output
