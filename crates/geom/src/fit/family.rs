//! An element as the solvers see it: unknowns, rows and distances in its own frame.

use super::sample::Sample;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, Vector, plus, times};

/// A frame and at most two sizes: an element of whatever family, in the unit frame of its sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Element {
    pub pose: Pose,
    pub size: [f64; 2],
}

/// Takes the rows of one point: one, or two where the distance is not signed. (A closure would do, but it cannot be made sure
/// to be inlined. The wide registers live only in code inlined into a function compiled for them.)
pub(super) trait Rows<const P: usize> {
    /// A residual and its derivatives by the unknowns.
    fn row(&mut self, d: f64, g: [f64; P]);
}

/// One family of elements with `P` unknowns. The formulas are written in the element's own frame, where they
/// are short, and about the element as it stands (all unknowns zero).
pub(super) trait Family<const P: usize>: Sync {
    /// The unknowns, in the order of the columns of the Jacobian.
    const LOCAL: [Local; P];
    /// Whether the distance is signed. The distance to a curve in space is not.
    const SIGNED: bool = true;
    /// Axes of its frame along which the element has no end: the points do not determine its origin along them. Its shape is reported
    /// with the origin at the foot of the points' mean.
    const FREE: &'static [usize] = &[];

    /// Hands each row of the least-squares problem for the point `q` to `rows`: residual and its derivatives.
    fn rows(size: [f64; 2], q: Point, rows: &mut impl Rows<P>);
    /// Orthogonal distance of the point `q`, positive outside.
    fn distance(size: [f64; 2], q: Point) -> f64;
    /// The change of the unknowns when all points move by a unit along a free axis and the origin stays.
    fn answer(_size: [f64; 2]) -> [f64; P] {
        [0.0; P]
    }
    /// Whether these sizes make an element.
    fn sound(size: [f64; 2]) -> bool {
        size.iter().all(|x| x.is_finite())
    }
    /// Elements near which the best one is to be sought. Empty where the points determine none.
    fn starts(points: &[Point]) -> Vec<Element>;
    /// The same element, written the way results state it: which of the two directions, which half axis first.
    fn settled(element: Element) -> Element {
        element.facing_up(2)
    }
    /// Further elements to start from where those of [`Family::starts`] lead to no good fit: a wider, slower search.
    fn more_starts(_points: &[Point]) -> Vec<Element> {
        Vec::new()
    }
    /// The element with a corner of its distances at a point, if one lies so close to such a corner. Distances are not linear there, and a
    /// search may not reach it.
    fn at_corner(_element: &Element, _sample: &Sample, _within: f64) -> Option<Element> {
        None
    }
    /// The element in the frame of the points.
    fn shape(element: &Element, sample: &Sample) -> Shape;
    /// The element of a shape given by the caller; `None` if it is of another family or has no direction.
    fn element(shape: &Shape, sample: &Sample) -> Option<Element>;
}

impl Element {
    /// The element after the step `step` of the unknowns `local`; `None` if a number stops being finite.
    pub(super) fn moved<const P: usize>(&self, local: &[Local; P], step: &[f64; P]) -> Option<Element> {
        self.stepped(local, step, Pose::moved)
    }
    /// As [`Element::moved`] to first order ([`Pose::nudged`]), in less time: for differences.
    pub(super) fn nudged<const P: usize>(&self, local: &[Local; P], step: &[f64; P]) -> Option<Element> {
        self.stepped(local, step, Pose::nudged)
    }
    fn stepped<const P: usize>(
        &self,
        local: &[Local; P],
        step: &[f64; P],
        motion: fn(&Pose, Vector, [f64; 2], f64) -> Pose,
    ) -> Option<Element> {
        let (mut shift, mut tilt, mut turn, mut size) = ([0.0; 3], [0.0; 2], 0.0, self.size);
        for (unknown, &x) in local.iter().zip(step) {
            match *unknown {
                Local::Shift(k) => shift[k] += x,
                Local::Tilt(k) => tilt[k] += x,
                Local::Turn => turn += x,
                Local::Size(k) => size[k] += x,
            }
        }
        let pose = motion(&self.pose, shift, tilt, turn);
        let finite = pose.origin.iter().chain(&size).all(|x| x.is_finite());
        finite.then_some(Element { pose, size })
    }
    /// The same frame with axis `k` turned about if its component of largest magnitude is negative.
    pub(super) fn facing_up(mut self, k: usize) -> Element {
        let axis = self.pose.axes[k];
        let greatest = (0..3).max_by(|&i, &j| axis[i].abs().total_cmp(&axis[j].abs())).unwrap_or(0);
        if axis[greatest] < 0.0 {
            self = self.reversed(k);
        }
        self
    }
    /// The same frame with axis `k` and the next one turned about.
    pub(super) fn reversed(mut self, k: usize) -> Element {
        for axis in [k, (k + 1) % 3] {
            self.pose.axes[axis] = times(-1.0, self.pose.axes[axis]);
        }
        self
    }
    /// The foot of `place`: the origin moved along these axes.
    pub(super) fn foot(&self, place: Point, free: &[usize]) -> Point {
        let at = self.pose.local(place);
        free.iter().fold(self.pose.origin, |p, &k| plus(p, times(at[k], self.pose.axes[k])))
    }
    /// The element with its origin moved along the third axis to the foot of `place`.
    pub(super) fn footed(mut self, place: Point) -> Element {
        let along = self.pose.local(place)[2];
        self.pose = self.pose.moved([0.0, 0.0, along], [0.0; 2], 0.0);
        self
    }
}

/// Distance and its derivatives, whether the rows give it whole or by components.
pub(super) fn slope<const P: usize, F: Family<P>>(size: [f64; 2], q: Point) -> (f64, [f64; P]) {
    struct Joined<const P: usize>(f64, [f64; P]);
    impl<const P: usize> Rows<P> for Joined<P> {
        fn row(&mut self, d: f64, g: [f64; P]) {
            self.0 += d * d;
            for k in 0..P {
                self.1[k] += d * g[k];
            }
        }
    }
    struct Only<const P: usize>(f64, [f64; P]);
    impl<const P: usize> Rows<P> for Only<P> {
        fn row(&mut self, d: f64, g: [f64; P]) {
            *self = Only(d, g);
        }
    }
    if F::SIGNED {
        let mut only = Only(0.0, [0.0; P]);
        F::rows(size, q, &mut only);
        return (only.0, only.1);
    }
    let mut joined = Joined(0.0, [0.0; P]);
    F::rows(size, q, &mut joined);
    let distance = joined.0.sqrt();
    let inverse = if distance > 0.0 { 1.0 / distance } else { 0.0 };
    (distance, joined.1.map(|x| x * inverse))
}
