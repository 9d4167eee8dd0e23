# a square of edge 2 round the origin; made for quadloop, free to use under its licence
1
frame
4
-1 -1
1 -1
1 1
-1 1
