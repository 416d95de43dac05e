//! Alignments end on the faces.

use super::faces::CadFaces;
use trueness_cad::search::{On, Side};
use trueness_geom::align::{ExactFoot, ExactSurface};
use trueness_geom::closest::QueryError;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;

impl ExactSurface for CadFaces {
    fn feet(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<Option<ExactFoot>>, QueryError> {
        self.search.map(points, progress, |_, near| {
            let normal = near.normal.filter(|_| near.distance.is_finite())?;
            Some(ExactFoot {
                place: near.place,
                normal,
                is_within: matches!(near.on, On::Face(_)),
                is_border: near.side == Side::Open,
            })
        })
    }
}
