//! Planes that cut a mesh or a cloud.

use crate::options::number;
use clap::Args;
use trueness::tasks::section::SectionRequest;

/// Where a mesh or cloud is cut.
#[derive(Args, Debug)]
#[command(next_help_heading = "Planes")]
pub struct PlaneArgs {
    /// Cut a mesh or cloud by the plane with normal nx,ny,nz at the distance d from the origin; may be repeated
    #[arg(long, value_name = "NX,NY,NZ,D", allow_hyphen_values = true, value_parser = numbers::<4>)]
    plane: Vec<[f64; 4]>,
    /// Cut by parallel planes: their normal, first and last distance from the origin, and step
    #[arg(long, value_name = "NX,NY,NZ,FROM,TO,STEP", allow_hyphen_values = true, value_parser = numbers::<6>)]
    stack: Vec<[f64; 6]>,
    /// Thickness of the slab of a cloud whose points count as points of the plane, mm
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    thickness: Option<f64>,
    /// Contours of a cloud continue over gaps up to this, mm [default: from the spacing of the points; the table names it]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    gap: Option<f64>,
}

impl PlaneArgs {
    /// The request with these.
    pub fn ask(&self, request: SectionRequest) -> SectionRequest {
        SectionRequest {
            plane: self.plane.clone(),
            stack: self.stack.clone(),
            thickness: self.thickness,
            gap: self.gap,
            ..request
        }
    }
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let all: Option<Vec<f64>> =
        text.split(',').map(|w| w.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let all = all.ok_or_else(|| format!("give {N} numbers with commas between them"))?;
    <[f64; N]>::try_from(all).map_err(|all| format!("give {N} numbers, not {}", all.len()))
}
