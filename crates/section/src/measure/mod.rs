//! Measures of contours.
//!
//! | file | what |
//! |---|---|
//! | `dimension` | angles, widths, distances of centers, gaps |
//! | `airfoil` | chord, camber, thickness and edges of a profile |
//! | `chords` | its chord by each of the usual definitions |
//! | `joined` | outlines of the segments of a drawing |
//! | `nominal`, `covered` | distances from the section of a nominal, and what of it is covered |
//! | `onto` | the best fit onto that |
//! | `tidy` | relations and whole numbers that the points allow, as offers |

pub(super) mod airfoil;
pub(super) mod chords;
pub(super) mod covered;
pub(super) mod dimension;
pub(super) mod joined;
pub(super) mod nominal;
pub(super) mod onto;
pub(super) mod tidy;
