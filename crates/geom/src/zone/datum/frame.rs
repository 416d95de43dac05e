//! The frame that datums make, one after the other.

use super::attitude::{AS_DRAWN, Freedom, System, nearest};
use super::{Datum, DatumError};
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, least_axis, minus, norm, plus, times, unit};
use std::f64::consts::FRAC_PI_2;

/// Why an axis at this angle to the attitude of others, which leave a turn free, is none of their system.
pub(super) fn misfit(datum: usize, angle: f64) -> DatumError {
    match (angle - FRAC_PI_2).abs() <= AS_DRAWN {
        true => DatumError::Across { datum },
        false => DatumError::Oblique { datum, degrees: angle.to_degrees() },
    }
}

/// The motions fixed so far.
#[derive(Default)]
pub(super) struct State {
    z: Option<Vector>,
    x: Option<Vector>,
    /// A point that holds the origin along z.
    height: Option<Point>,
    /// A point that holds it along x.
    along_x: Option<Point>,
    /// A point that holds it along y.
    along_y: Option<Point>,
    /// Whether the first datum is an axis whose sense is still open.
    open: bool,
}

impl State {
    /// Takes in the next datum.
    pub(super) fn add(&mut self, datum: usize, d: &Datum) -> Result<(), DatumError> {
        let Some(z) = self.z else {
            return self.first(datum, d);
        };
        match *d {
            Datum::Plane { point, normal } => self.plane(datum, z, point, normal),
            Datum::Axis { point, direction } => match (nearest(&[z], direction), self.x) {
                (Ok(_), _) => self.place(datum, z, point),
                (Err(_), Some(x)) => self.crossing(datum, [x, cross(z, x), z], point, direction),
                (Err(angle), None) => Err(misfit(datum, angle)),
            },
            Datum::Point(point) => self.place(datum, z, point),
        }
    }

    fn first(&mut self, datum: usize, d: &Datum) -> Result<(), DatumError> {
        match *d {
            Datum::Plane { point, normal } => {
                self.z = Some(times(-1.0, normal));
                self.height = Some(point);
            }
            Datum::Axis { point, direction } => {
                self.z = Some(direction);
                (self.along_x, self.along_y, self.open) = (Some(point), Some(point), true);
            }
            Datum::Point(_) => {
                let _ = datum;
                return Err(DatumError::Unsupported { what: "a center as the first datum" });
            }
        }
        Ok(())
    }

    fn plane(&mut self, datum: usize, z: Vector, point: Point, normal: Vector) -> Result<(), DatumError> {
        let angle = libm::acos(dot(z, normal).abs().min(1.0));
        let degrees = angle.to_degrees();
        if angle <= AS_DRAWN {
            if self.height.is_some() {
                return Err(DatumError::Idle { datum, degrees });
            }
            self.height = Some(point);
            if self.open {
                self.z = Some(if dot(z, normal) > 0.0 { times(-1.0, z) } else { z });
                self.open = false;
            }
            return Ok(());
        }
        if (angle - FRAC_PI_2).abs() > AS_DRAWN {
            return Err(DatumError::Oblique { datum, degrees });
        }
        match self.x {
            None => {
                self.x = Some(times(-1.0, normal));
                self.along_x = self.along_x.or(Some(point));
                Ok(())
            }
            Some(x) => {
                let turn = libm::acos(dot(x, normal).abs().min(1.0));
                if (turn - FRAC_PI_2).abs() > AS_DRAWN {
                    return Err(DatumError::Idle { datum, degrees: turn.to_degrees() });
                }
                if self.along_y.is_some() {
                    return Err(DatumError::Idle { datum, degrees });
                }
                self.along_y = Some(point);
                Ok(())
            }
        }
    }

    /// An axis across z where all turns are held, as of a cross bore: what is still free of the two shifts across it.
    fn crossing(
        &mut self,
        datum: usize,
        axes: [Vector; 3],
        point: Point,
        direction: Vector,
    ) -> Result<(), DatumError> {
        let oblique = |angle: f64| DatumError::Oblique { datum, degrees: angle.to_degrees() };
        nearest(&axes, direction).map_err(oblique)?;
        let is_along_x = nearest(&axes[..1], direction).is_ok();
        let across = if is_along_x { &mut self.along_y } else { &mut self.along_x };
        if across.is_some() && self.height.is_some() {
            return Err(DatumError::Idle { datum, degrees: 90.0 });
        }
        *across = across.or(Some(point));
        self.height = self.height.or(Some(point));
        Ok(())
    }

    /// A center, or an axis along z: a place in the plane across z.
    fn place(&mut self, datum: usize, z: Vector, point: Point) -> Result<(), DatumError> {
        match (self.along_x, self.along_y, self.x) {
            (None, None, _) => (self.along_x, self.along_y) = (Some(point), Some(point)),
            (Some(_), None, Some(_)) => self.along_y = Some(point),
            (Some(origin), Some(_), None) => {
                let way = minus(point, origin);
                let flat = minus(way, times(dot(way, z), z));
                let Some((x, length)) = unit(flat) else {
                    return Err(DatumError::Idle { datum, degrees: 0.0 });
                };
                if length <= 1e-9 * norm(way) {
                    return Err(DatumError::Idle { datum, degrees: 0.0 });
                }
                self.x = Some(x);
            }
            _ => return Err(DatumError::Idle { datum, degrees: 0.0 }),
        }
        Ok(())
    }

    /// The frame.
    pub(super) fn finished(self, datums: &[Datum]) -> Result<System, DatumError> {
        let Some(z) = self.z else { return Err(DatumError::Unsupported { what: "no datums" }) };
        let free = Freedom {
            shift: [self.along_x.is_none(), self.along_y.is_none(), self.height.is_none()],
            turn: [false, false, self.x.is_none()],
        };
        let lost = DatumError::Unsupported { what: "directions that make no frame" };
        let turned = Rigid::into_frame([0.0; 3], z, self.x.unwrap_or(least_axis(z))).ok_or(lost)?;
        let [x, y, z] = turned.rotation();
        // Where nothing holds the origin, it is at a datum all the same.
        let anywhere = self.along_x.or(self.along_y).or(self.height).unwrap_or([0.0; 3]);
        let at = |p: Option<Point>, axis: Vector| dot(p.unwrap_or(anywhere), axis);
        let (a, b, c) = (at(self.along_x, x), at(self.along_y, y), at(self.height, z));
        let origin = plus(plus(times(a, x), times(b, y)), times(c, z));
        let frame = Rigid::into_frame(origin, z, x).ok_or(lost)?;
        Ok(System { frame, free, datums: datums.to_vec() })
    }
}
