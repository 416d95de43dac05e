//! Which sign method is valid for a reference, and why.
//!
//! Pseudonormals (Bærentzen & Aanæs 2005) are exact on one condition. Every edge has two facets that agree on the outside, and
//! the surface winds around each place once or not at all. Shells that overlap break the second: there the winding number
//! counts the solids around a place, and one or more is material. So a shell in another one that looks the same way is material
//! in material, one that looks the other way a cavity. The generalized winding number (Jacobson et al. 2013) tolerates gaps and
//! doubled facets as long as the surface nearly encloses a volume. On an open sheet it never reaches one half. The *vector
//! area* tells the two apart. The sum of the facets' area vectors is zero for a closed surface, and as long as the area itself
//! for a flat sheet.

use crate::check::Precondition;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Vector, cross, minus, norm, plus};
use std::fmt;

/// The user's request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SignRequest {
    /// The valid method for this reference.
    #[default]
    Auto,
    /// Angle-weighted pseudonormals, valid or not.
    Pseudonormal,
    /// Generalized winding number.
    Winding,
    /// Unsigned distances.
    None,
}

/// The method that is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignMethod {
    /// Side of the angle-weighted pseudonormal of the facet, edge or vertex hit.
    Pseudonormal,
    /// Inside where the winding number exceeds one half.
    Winding,
    /// Side of the normal of a B-spline surface.
    Normal,
    /// No sign: distances.
    None,
}

/// The method and the reason for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignChoice {
    /// The request.
    pub requested: SignRequest,
    /// The method.
    pub method: SignMethod,
    /// Why.
    pub reason: SignReason,
    /// The reference encloses a negative volume: it is inside out, and its signs are taken the other way round.
    pub inside_out: bool,
}

/// Why a sign method was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SignReason {
    /// It was asked for.
    Requested,
    /// The reference is a B-spline surface, whose normal looks to one side.
    Normal,
    /// It was asked for, and the reference is not closed, consistently oriented and free of overlapping shells as the method
    /// needs it.
    RequestedUnsound,
    /// The reference is closed and consistently oriented.
    Closed,
    /// The reference is closed and consistently oriented, but its shells cross or touch, or one lies in another and looks
    /// the way that one does.
    Overlapping,
    /// The reference has gaps, but nearly encloses a volume.
    NearlyClosed {
        /// Edges with one facet.
        boundary_edges: usize,
    },
    /// The reference is closed, but facets disagree about the outside, coincide, or meet more than two at an edge.
    Inconsistent,
    /// The reference is an open sheet: no volume, but two sides.
    OpenSheet {
        /// Length of the summed area vectors over the area, 0 (closed) to 1 (flat).
        openness: f64,
    },
}

/// Ratio of vector area to area above which a surface is a sheet and encloses nothing. A hemisphere without its base has 0.5, a
/// scanned figure open at its foot 0.01 to 0.1.
pub const MIN_SHEET_OPENNESS: f64 = 0.25;

impl SignChoice {
    /// That of B-spline surfaces: their normal, unless no sign is asked for.
    pub fn by_normal(requested: SignRequest) -> SignChoice {
        let (method, reason) = match requested {
            SignRequest::None => (SignMethod::None, SignReason::Requested),
            _ => (SignMethod::Normal, SignReason::Normal),
        };
        SignChoice { requested, method, reason, inside_out: false }
    }
    /// Chooses for a mesh of which this is known. Cost: linear in the facets.
    ///
    /// One shell that crosses itself is not told from one that does not. Where it overlaps itself, pseudonormals may call the
    /// inside outside, and winding numbers must be asked for.
    ///
    /// # Panics
    /// If a facet names a vertex that does not exist.
    pub fn new(requested: SignRequest, known: &Precondition, mesh: &Mesh) -> SignChoice {
        let soundness = &known.soundness;
        let openness = openness(mesh);
        let valid = soundness.oriented() && !known.shells_overlap;
        let (method, reason) = match requested {
            SignRequest::None => (SignMethod::None, SignReason::Requested),
            SignRequest::Winding if openness > MIN_SHEET_OPENNESS => {
                (SignMethod::Winding, SignReason::RequestedUnsound)
            }
            SignRequest::Winding => (SignMethod::Winding, SignReason::Requested),
            SignRequest::Pseudonormal if valid => (SignMethod::Pseudonormal, SignReason::Requested),
            SignRequest::Pseudonormal => (SignMethod::Pseudonormal, SignReason::RequestedUnsound),
            SignRequest::Auto if valid => (SignMethod::Pseudonormal, SignReason::Closed),
            SignRequest::Auto if soundness.oriented() => (SignMethod::Winding, SignReason::Overlapping),
            SignRequest::Auto if soundness.closed => (SignMethod::Winding, SignReason::Inconsistent),
            SignRequest::Auto if openness > MIN_SHEET_OPENNESS => {
                (SignMethod::Pseudonormal, SignReason::OpenSheet { openness })
            }
            SignRequest::Auto => {
                (SignMethod::Winding, SignReason::NearlyClosed { boundary_edges: soundness.boundary_edges })
            }
        };
        let encloses = method != SignMethod::None && openness <= MIN_SHEET_OPENNESS;
        SignChoice { requested, method, reason, inside_out: encloses && !soundness.outward }
    }
}

/// Length of the mesh's vector area over its area: 0 closed, 1 flat; 0 for a mesh without area.
fn openness(mesh: &Mesh) -> f64 {
    let of = |part: &[[u32; 3]]| {
        part.iter().fold(([0.0; 3], 0.0), |(vector, area): (Vector, f64), f| {
            let [a, b, c] = mesh.places(f);
            let n = cross(minus(b, a), minus(c, a));
            (plus(vector, n), area + norm(n))
        })
    };
    let parts: Vec<(Vector, f64)> = mesh.faces.par_chunks(1 << 12).map(of).collect();
    let (vector, area) = parts.iter().fold(([0.0; 3], 0.0), |s, p| (plus(s.0, p.0), s.1 + p.1));
    if area > 0.0 { norm(vector) / area } else { 0.0 }
}

impl SignRequest {
    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            SignRequest::Auto => "auto",
            SignRequest::Pseudonormal => "pseudonormal",
            SignRequest::Winding => "winding",
            SignRequest::None => "none",
        }
    }
}

impl SignMethod {
    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            SignMethod::Pseudonormal => "pseudonormal",
            SignMethod::Winding => "winding",
            SignMethod::Normal => "normal",
            SignMethod::None => "none",
        }
    }
}

impl fmt::Display for SignChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.reason {
            SignReason::Requested => write!(f, "asked for")?,
            SignReason::RequestedUnsound => write!(
                f,
                "asked for, although the reference is not closed and consistently oriented, or its shells overlap"
            )?,
            SignReason::Normal => write!(
                f,
                "the reference is a B-spline surface: the side that its normal, u times v, looks to is outside"
            )?,
            SignReason::Closed => write!(f, "the reference is closed and consistently oriented")?,
            SignReason::Overlapping => {
                write!(f, "the reference's shells cross, touch, or contain each other the same way round")?
            }
            SignReason::NearlyClosed { boundary_edges } => {
                write!(f, "the reference is open at {boundary_edges} edges, but nearly encloses a volume")?
            }
            SignReason::Inconsistent => write!(
                f,
                "the reference's facets disagree about the outside, coincide, or meet more than two at an edge"
            )?,
            SignReason::OpenSheet { openness } => write!(
                f,
                "the reference is an open sheet (vector area {openness:.2} of its area): side of the nearest facet"
            )?,
        }
        if self.inside_out {
            write!(f, "; it is inside out, and signs are taken for the outward side")?;
        }
        Ok(())
    }
}
