# farfield: square, half width 10, centre (0.5, 0)
1
farfield
4
-9.5 -10
10.5 -10
10.5 10
-9.5 10
