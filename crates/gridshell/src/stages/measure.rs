//! Measures of a grid (Section 7, Eq. 11 to 14 and 23 to 32) and the floors of mu and delta.
