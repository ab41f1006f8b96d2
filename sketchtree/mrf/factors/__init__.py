"""The kinds of factor, one a file: a frozen record of columns with `log_potential(assignment, theta)`.

`present` is 1 at a factor and 0 at padding. The log posterior is the sum over all kinds (Chen 2008, Eq. 3, with our
kinds); a new factor is a new file.
"""
