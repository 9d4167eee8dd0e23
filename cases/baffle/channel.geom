# A channel of length 4 and height 1; the domain is to the left of each line.
4
bottom open
2
0 0
4 0
outlet open
2
4 0
4 1
top open
2
4 1
0 1
inlet open
2
0 1
0 0
