# A channel of height 1 and length 3 with a step of height 0.2 at x = 0.6
4
inlet open
2
0 1
0 0
floor open
4
0 0
0.6 0
0.6 0.2
3 0.2
outlet open
2
3 0.2
3 1
roof open
2
3 1
0 1
