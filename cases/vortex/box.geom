# a square of edge 20 round the origin; made for quadloop, free to use under its licence
1
frame
4
-10 -10
10 -10
10 10
-10 10
