//! Common datums: one datum of several features (ISO 5459:2011).
//!
//! The ideal elements of all features are associated at once, with the exact constraints between them that the drawing implies.
//! They are coaxial, coplanar, or parallel and opposite. Radii of cylinders and the distance of opposite planes are free
//! (features of size). Coaxial cylinders and lines give their axis, coplanar planes their plane, two opposite planes their
//! median plane; its normal is that of the first.

use super::associate::{across_normal, associate, outside};
use super::attitude::{AS_DRAWN, Held, nearest};
use super::joint::{Form, Joint, MAX_COMMON_FEATURES, Stand};
use super::{Datum, DatumError, Rule, Source};
use crate::fit::{self, Options};
use crate::progress::Progress;
use crate::shape::Kind;
use crate::space::{Aabb, Point, Vector, cross, dot, least_axis, minus, norm, plus, times, unit};
use crate::zone::mean::mean;
use std::f64::consts::FRAC_PI_2;

/// The features of a common datum, and their attitude.
pub(super) struct Common<'a> {
    /// Its number.
    pub datum: usize,
    pub sources: &'a [Source<'a>],
    pub rule: Rule,
    pub held: Held,
    pub progress: &'a dyn Progress,
}

impl Common<'_> {
    /// The datum.
    pub(super) fn associated(&self) -> Result<Datum, DatumError> {
        if !(2..=MAX_COMMON_FEATURES).contains(&self.sources.len()) {
            return Err(self.wrong("it is made of two or three features"));
        }
        let all = |kinds: &[Kind]| self.sources.iter().all(|s| kinds.contains(&s.kind));
        if all(&[Kind::Plane]) {
            return self.planes();
        }
        if all(&[Kind::Cylinder, Kind::Line]) {
            return self.coaxial();
        }
        Err(self.wrong("it is made of planes, or of cylinders and lines, and of nothing else"))
    }

    fn wrong(&self, what: &'static str) -> DatumError {
        DatumError::Common { datum: self.datum, what }
    }

    fn oblique(&self, angle: f64) -> DatumError {
        DatumError::Oblique { datum: self.datum, degrees: angle.to_degrees() }
    }

    /// Where the element of each feature stands, by least squares alone: a point of it near the feature, and its direction.
    fn owns(&self) -> Result<Vec<(Point, Vector)>, DatumError> {
        let one = |source: &Source| {
            let found = fit::fit(source.points, source.kind, &Options::default(), self.progress);
            let shape = found.map_err(|error| DatumError::Fit { datum: self.datum, error })?.shape;
            match (shape.foot(), shape.direction()) {
                (Some(at), Some(way)) => {
                    let along = dot(minus(mean(source.points), at), way);
                    Ok((plus(at, times(along, way)), way))
                }
                _ => Err(self.wrong("a feature of it has no direction")),
            }
        };
        self.sources.iter().map(one).collect()
    }

    /// The elements near `start`, by the rule.
    fn settled(&self, joint: &Joint, start: Stand) -> Result<Stand, DatumError> {
        let stand = match self.rule {
            Rule::Gaussian => start,
            Rule::MinimumZone => {
                let zone = joint.least_greatest(&start, self.progress);
                zone.map_err(|error| DatumError::Zone { datum: self.datum, error })?
            }
        };
        Ok(joint.placed(&stand))
    }

    fn coaxial(&self) -> Result<Datum, DatumError> {
        let owns = self.owns()?;
        let (first, last) = (owns[0], owns[owns.len() - 1]);
        let middle = times(1.0 / owns.len() as f64, owns.iter().fold([0.0; 3], |s, o| plus(s, o.0)));
        let held: &[Vector] = match &self.held {
            Held::Nothing => &[],
            Held::Along(z) => std::slice::from_ref(z),
            Held::All(axes) => axes,
        };
        let starts: Vec<Vector> = match held {
            // Short features tell their own directions badly, features side by side that of the line through them.
            [] => {
                let joining = unit(minus(last.0, first.0)).map(|(way, _)| way);
                owns.iter().map(|o| o.1).chain(joining).collect()
            }
            held => vec![nearest(held, first.1).map_err(|angle| self.oblique(angle))?],
        };
        let joint = Joint::new(Form::Axis, self.sources, true, [held.is_empty(); 2]);
        let found = starts.iter().filter_map(|way| {
            joint.least_squares(&joint.about(middle, *way, least_axis(*way))).map(|s| (joint.square(&s), s))
        });
        let best = found.min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, best) = best.ok_or(self.wrong("its features determine no axis"))?;
        let Stand { pose, sizes } = self.settled(&joint, best)?;
        let way = pose.axes[2];
        // Features that are not coaxial as drawn: their points are far from any common element.
        let extent = Aabb::of(self.sources.iter().flat_map(|s| s.points)).diagonal();
        for (source, radius) in self.sources.iter().zip(sizes) {
            let reach = if source.kind == Kind::Line { extent } else { radius };
            let off = |p: &Point| (norm(cross(minus(*p, pose.origin), way)) - radius).abs();
            if source.points.iter().map(off).fold(0.0, f64::max) > AS_DRAWN * reach {
                return Err(self.wrong(
                    "its features do not lie about one axis; only coaxial ones make a common datum here",
                ));
            }
        }
        let way = if dot(way, first.1) < 0.0 { times(-1.0, way) } else { way };
        Ok(Datum::Axis { point: pose.origin, direction: way })
    }

    fn planes(&self) -> Result<Datum, DatumError> {
        let (owns, sources) = (self.owns()?, self.sources);
        let normals: Vec<Vector> = owns.iter().zip(sources).map(|(o, s)| outside(o.1, s.outward)).collect();
        for n in &normals[1..] {
            nearest(&normals[..1], *n).map_err(|angle| self.oblique(angle))?;
        }
        if normals.iter().any(|n| dot(*n, normals[0]) < 0.0) {
            return match sources.len() {
                2 => self.median(&normals),
                _ => Err(self.wrong("of opposite planes it is made of two")),
            };
        }
        // All face one way: they are one plane, if no step is between them.
        let stepped = owns[1..].iter().any(|o| {
            let way = minus(o.0, owns[0].0);
            dot(way, normals[0]).abs() > AS_DRAWN * norm(way)
        });
        if stepped {
            return Err(self.wrong(
                "its planes face one way at different heights; only coplanar and opposite planes make a common datum \
                 here (give `outward` where the side of the material is not found rightly)",
            ));
        }
        let points: Vec<Point> = sources.iter().flat_map(|s| s.points).copied().collect();
        let whole = Source { points: &points, kind: Kind::Plane, outward: sources[0].outward };
        associate(self.datum, &whole, self.rule, self.held, self.progress)
    }

    /// The plane half way between two opposite planes of one normal.
    fn median(&self, normals: &[Vector]) -> Result<Datum, DatumError> {
        let near = normals[0];
        // The axis that holds a normal across it is the frame's y: the normal may lean towards x alone.
        let (tilt, z, toward) = match self.held {
            Held::Nothing => ([true; 2], near, least_axis(near)),
            Held::Along(axis) => match nearest(&[axis], near) {
                Ok(z) => ([false; 2], z, least_axis(z)),
                Err(angle) if (angle - FRAC_PI_2).abs() <= AS_DRAWN => {
                    let z = across_normal(axis, near).ok_or(self.oblique(angle))?;
                    ([true, false], z, cross(axis, z))
                }
                Err(angle) => return Err(self.oblique(angle)),
            },
            Held::All(axes) => {
                let z = nearest(&axes, near).map_err(|angle| self.oblique(angle))?;
                ([false; 2], z, least_axis(z))
            }
        };
        let middle = mean(self.sources[0].points);
        let joint = Joint::new(Form::Planes, self.sources, false, tilt);
        let best = joint.least_squares(&joint.about(middle, z, toward));
        let best = best.ok_or(self.wrong("its planes determine no normal"))?;
        let Stand { pose, sizes } = self.settled(&joint, best)?;
        let z = pose.axes[2];
        // By minimum zone each plane touches its material from outside.
        let touching = |part: usize| -> f64 {
            let heights = self.sources[part].points.iter().map(|p| dot(minus(*p, pose.origin), z));
            match dot(normals[part], z) > 0.0 {
                true => heights.fold(f64::NEG_INFINITY, f64::max),
                false => heights.fold(f64::INFINITY, f64::min),
            }
        };
        let heights = match self.rule {
            Rule::Gaussian => [sizes[0], sizes[1]],
            Rule::MinimumZone => [touching(0), touching(1)],
        };
        let point = plus(pose.origin, times(0.5 * (heights[0] + heights[1]), z));
        // The point of the plane beside the first feature.
        let point = plus(middle, times(dot(minus(point, middle), z), z));
        Ok(Datum::Plane { point, normal: outside(z, near) })
    }
}
