//! Where planes cut a mesh, and the contours there.
//!
//! | file | what |
//! |---|---|
//! | `plane` | where a plane cuts a mesh |
//! | `edge_chain` | its edges put in order |
//! | `stack` | which facets each of many planes may cut |
//! | `scan` | crossings of a scan: moved onto the surface, weighted by the noise they share |
//! | `tessellated` | contours of both |

mod edge_chain;
pub(super) mod plane;
pub(super) mod scan;
pub(super) mod stack;
pub(super) mod tessellated;
