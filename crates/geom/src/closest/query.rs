//! Answering the points: blocks of sixteen neighbors share one walk through the tree.
//!
//! For each block (module `search`):
//! 1. take a surface point `x` near the block: the closest one of the triangle that won in the block before;
//! 2. `prune`: collect, breadth first, the leaves and nodes that could hold a triangle closer than `x` to *some* point of the
//!    block. It goes on as long as they are few;
//! 3. few leaves and nothing else (points dense compared with triangles): test every remaining triangle against all sixteen
//!    points at once (`leaf_triangles`). Else the sixteen points search on from there in lockstep, each with its own bound
//!    (`lockstep`);
//! 4. `decide`: every triangle within the error bound of a point's best is computed in double precision; ties go to the
//!    lowest face.
//!
//! Single precision only excludes. So neither the order of the points nor their chunks, nor the number of threads, nor the
//! instruction set can change a result.
#![expect(
    unsafe_code,
    reason = "choosing the instruction set at run time; answers written to places of their own"
)]

use crate::closest::hit::Hit;
use crate::closest::limits::{QueryError, sane};
use crate::closest::order;
use crate::closest::search::{self, Scratch, Sink};
use crate::closest::tree::{Closest, Tree};
use crate::memory::{Shared, large_pages};
use crate::progress::Progress;
use crate::simd::Level;
use crate::space::Point;

/// The request for a batch of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Greatest distance that counts, millimeters; a point farther from the mesh has no answer. A small one makes the
    /// search faster.
    pub max_distance: f64,
    /// Instructions to use; more than the processor has means all it has.
    pub instructions: Level,
}

impl Default for Query {
    fn default() -> Self {
        Query { max_distance: f64::INFINITY, instructions: Level::detect() }
    }
}

impl Tree {
    /// The point of the mesh closest to `p`, or `None` if it is farther than `max_distance` (which may be infinite).
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] and [`QueryError::BadMaxDistance`].
    pub fn closest(&self, p: &Point, max_distance: f64) -> Result<Option<Closest>, QueryError> {
        Ok(self.hit(p, max_distance)?.map(|hit| self.place(p, &hit)))
    }

    /// As [`Tree::closest`], where [`Tree::place`] finds the place: of a single point what [`Tree::map_closest`] tells of many, without putting them in order.
    ///
    /// # Errors
    /// The errors of [`Tree::closest`].
    pub fn hit(&self, p: &Point, max_distance: f64) -> Result<Option<Hit>, QueryError> {
        let query = Query { max_distance, ..Query::default() };
        query.check()?;
        if !sane(p) {
            return Err(QueryError::BadPoint(0));
        }
        let answer = std::cell::Cell::new(Hit::NONE);
        answer_items(self, &query, std::slice::from_ref(p), &[0], &mut Scratch::default(), &|_, hits| {
            answer.set(hits[0])
        });
        let hit = answer.get();
        Ok((hit.distance() <= max_distance).then_some(hit))
    }

    /// Calls `sink(index, hit)` exactly once for every point, from several threads and in no particular order; `None`
    /// for a point farther from the mesh than `query.max_distance`. The answers depend on nothing but mesh and point.
    ///
    /// Runs on the current rayon pool and tells `progress` of points answered. Cost: about 0.1 to 0.3 µs a point and core for
    /// scans, 1 µs for points far away. It is as much as brute force where very many faces are equally near. Such places are
    /// the center of a sphere or many mesh sizes away. Memory: 8 bytes a point, 64 MiB at most.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] names the first bad point of the first 8 million that have one; earlier millions have
    /// been answered by then. [`QueryError::BadMaxDistance`], [`QueryError::Cancelled`].
    pub fn for_each_closest(
        &self,
        points: &[Point],
        query: &Query,
        progress: &dyn Progress,
        sink: impl Fn(usize, Option<Hit>) + Sync,
    ) -> Result<(), QueryError> {
        query.check()?;
        order::for_each_bucket(points, progress, |scratch: &mut Scratch, slice, base, items| {
            answer_items(self, query, slice, items, scratch, &|items, hits| {
                for (&i, hit) in items.iter().zip(hits) {
                    sink(base + i as u32 as usize, (hit.distance() <= query.max_distance).then_some(*hit));
                }
            });
        })
    }

    /// `f(index, hit)` of every point, in the order of `points`: [`Tree::for_each_closest`] with the answers collected.
    ///
    /// # Errors
    /// The errors of [`Tree::for_each_closest`].
    pub fn map_closest<T: Copy + Send>(
        &self,
        points: &[Point],
        query: &Query,
        progress: &dyn Progress,
        f: impl Fn(usize, Option<Hit>) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        let mut out = vec![];
        self.map_closest_into(points, query, progress, f, &mut out)?;
        Ok(out)
    }

    /// [`Tree::map_closest`] into memory that there is: what was in `out` is dropped. Empty after an error.
    ///
    /// # Errors
    /// The errors of [`Tree::for_each_closest`].
    pub(crate) fn map_closest_into<T: Copy + Send>(
        &self,
        points: &[Point],
        query: &Query,
        progress: &dyn Progress,
        f: impl Fn(usize, Option<Hit>) -> T + Sync,
        out: &mut Vec<T>,
    ) -> Result<(), QueryError> {
        out.clear();
        if out.capacity() < points.len() {
            *out = large_pages(Vec::with_capacity(points.len()));
        }
        let places = Shared::of(out);
        self.for_each_closest(points, query, progress, |i, hit| {
            let x = f(i, hit);
            // SAFETY: there is room for all, and each index comes exactly once.
            unsafe { *places.at(i) = x }
        })?;
        // SAFETY: no error: every index has come.
        unsafe { out.set_len(points.len()) };
        Ok(())
    }

    /// Distance of each point to the mesh, millimeters, in the order of `points`; NaN beyond `query.max_distance`.
    ///
    /// # Errors
    /// The errors of [`Tree::for_each_closest`].
    pub fn distances(
        &self,
        points: &[Point],
        query: &Query,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, QueryError> {
        self.map_closest(points, query, progress, |_, hit| hit.map_or(f64::NAN, |h| h.distance()))
    }
}

impl Query {
    /// Whether anything can be asked so.
    ///
    /// # Errors
    /// [`QueryError::BadMaxDistance`] where the greatest distance is negative or NaN.
    pub fn check(&self) -> Result<(), QueryError> {
        if self.max_distance >= 0.0 { Ok(()) } else { Err(QueryError::BadMaxDistance(self.max_distance)) }
    }
}

/// Answers the points named by `items` with the chosen instruction set.
fn answer_items(
    tree: &Tree,
    query: &Query,
    points: &[Point],
    items: &[u64],
    scratch: &mut Scratch,
    sink: Sink,
) {
    use crate::simd::lanes::Plain;
    let far = query.max_distance;
    #[cfg(target_arch = "x86_64")]
    {
        use crate::simd::lanes_x86::{A4d, A8, A16, Z8d, Z16};
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
        fn avx2(t: &Tree, p: &[Point], i: &[u64], far: f64, s: &mut Scratch, f: Sink) {
            // SAFETY: the features above are those of the types.
            unsafe { search::answer::<A8, A16, A4d>(t, p, i, far, s, f) }
        }
        #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
        fn avx512(t: &Tree, p: &[Point], i: &[u64], far: f64, s: &mut Scratch, f: Sink) {
            // SAFETY: the features above are those of the types.
            unsafe { search::answer::<A8, Z16, Z8d>(t, p, i, far, s, f) }
        }
        // SAFETY: `Level::detect` found these features.
        match query.instructions.min(Level::detect()) {
            Level::Avx512 => return unsafe { avx512(tree, points, items, far, scratch, sink) },
            Level::Avx2 => return unsafe { avx2(tree, points, items, far, scratch, sink) },
            Level::Plain => {}
        }
    }
    // SAFETY: plain Rust needs no special instructions.
    unsafe { search::answer::<Plain<8>, Plain<16>, f64>(tree, points, items, far, scratch, sink) }
}
