//! Point clouds, whole or in blocks.

use crate::space::Point;
use std::marker::PhantomData;

/// Points that arrive block by block, in the order of their file: the `i`-th point ever delivered *is* point `i`.
pub trait PointStream {
    /// Why the stream broke off.
    type Error;
    /// Number of points in all, where it is known beforehand. A file of several scans may announce the first alone.
    fn expected(&self) -> Option<u64>;
    /// Replaces the contents of `block` by the next points. An empty block ends the stream.
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), Self::Error>;
    /// What there is to tell of the points so far, a sentence each: how many records of a scan held none, for instance. Complete
    /// at the end of the stream.
    fn remarks(&self) -> Vec<String> {
        vec![]
    }
}

/// Points that are all there already, as a stream of one block that cannot fail.
///
/// ```
/// use trueness_geom::cloud::{PointStream, Whole};
/// let mut stream = Whole::<std::convert::Infallible>::new(vec![[1.0, 2.0, 3.0]]);
/// let mut block = vec![];
/// stream.next_block(&mut block)?;
/// assert_eq!(block, [[1.0, 2.0, 3.0]]);
/// stream.next_block(&mut block)?;
/// assert!(block.is_empty());
/// # Ok::<(), std::convert::Infallible>(())
/// ```
#[derive(Clone, Debug)]
pub struct Whole<E> {
    points: Vec<Point>,
    error: PhantomData<fn() -> E>,
}

impl<E> Whole<E> {
    /// A stream of these.
    pub fn new(points: Vec<Point>) -> Whole<E> {
        Whole { points, error: PhantomData }
    }
}

impl<E> PointStream for Whole<E> {
    type Error = E;
    fn expected(&self) -> Option<u64> {
        Some(self.points.len() as u64)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), E> {
        *block = std::mem::take(&mut self.points);
        Ok(())
    }
}
