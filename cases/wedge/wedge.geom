# a ramp of 10 degrees, 1 long along x, half a length behind the inlet; made for quadloop, free to use under its licence
5
inlet open
2
-0.5 1.2
-0.5 0
floor open
2
-0.5 0
0 0
ramp open
2
0 0
1 0.17632698070846498
outlet open
2
1 0.17632698070846498
1 1.2
top open
2
1 1.2
-0.5 1.2
