# outer edge of the cell on its cooling plate, micrometres; 'middle' is the plane of symmetry
6
middle open
2
0 619.6
0 -800
housing open
2
0 -800
900 -800
plate_end open
2
900 -800
900 0
air_below open
3
900 0
900 259.8
960 259.8
tab_end open
2
960 259.8
960 359.8
air_above open
4
960 359.8
900 359.8
900 619.6
0 619.6
