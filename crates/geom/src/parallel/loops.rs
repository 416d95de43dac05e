//! The loops themselves: what is done with each item, and what is made of all.

use super::collect::{FromParts, in_place, parts};
use super::source::{
    Chunks, Copies, Filtered, Flattened, Mapped, Numbered, Numbers, Owned, Slice, Source, Zipped,
};
use super::split::{count_parts, each_part, range};
use rayon::slice::ParallelSliceMut;
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// A loop over the items of a source, not begun yet.
#[derive(Debug)]
#[must_use = "a loop does nothing until its items are asked for"]
pub struct Loop<S> {
    source: S,
    least: usize,
}

/// Loops over references to what a slice holds.
pub trait Parallel<T> {
    /// Over each item.
    fn par_iter(&self) -> Loop<Slice<'_, T>>;
    /// Over pieces of `size` items, the last one with what is left. `size` is not 0.
    fn par_chunks(&self, size: usize) -> Loop<Chunks<'_, T>>;
    /// Over exclusive references to each item. Each costs a lock: for many cheap items there is `par_chunks_mut`.
    fn par_iter_mut(&mut self) -> Loop<Owned<&mut T>>;
    /// Over exclusive references to pieces of `size` items, the last one with what is left. `size` is not 0.
    fn par_chunks_mut(&mut self, size: usize) -> Loop<Owned<&mut [T]>>;
    /// Sorts; equal items may change places.
    fn par_sort_unstable(&mut self)
    where
        T: Ord + Send;
    /// Sorts; equal items keep their order.
    fn par_sort_by<F: Fn(&T, &T) -> Ordering + Sync>(&mut self, compare: F)
    where
        T: Send;
    /// Sorts; equal items may change places, and end the same way on any number of threads only where they do not differ.
    fn par_sort_unstable_by<F: Fn(&T, &T) -> Ordering + Sync>(&mut self, compare: F)
    where
        T: Send;
    /// Sorts by a key. Items with equal keys may change places, and end the same way on any number of threads only where they
    /// are equal.
    fn par_sort_unstable_by_key<K: Ord, F: Fn(&T) -> K + Sync>(&mut self, key: F)
    where
        T: Send;
}

impl<T> Parallel<T> for [T] {
    fn par_iter(&self) -> Loop<Slice<'_, T>> {
        Loop { source: Slice(self), least: 1 }
    }
    fn par_chunks(&self, size: usize) -> Loop<Chunks<'_, T>> {
        Loop { source: Chunks { slice: self, size: size.max(1) }, least: 1 }
    }
    fn par_iter_mut(&mut self) -> Loop<Owned<&mut T>> {
        Loop { source: self.iter_mut().collect(), least: 1 }
    }
    fn par_chunks_mut(&mut self, size: usize) -> Loop<Owned<&mut [T]>> {
        Loop { source: self.chunks_mut(size.max(1)).collect(), least: 1 }
    }
    fn par_sort_unstable(&mut self)
    where
        T: Ord + Send,
    {
        ParallelSliceMut::par_sort_unstable(self);
    }
    fn par_sort_by<F: Fn(&T, &T) -> Ordering + Sync>(&mut self, compare: F)
    where
        T: Send,
    {
        ParallelSliceMut::par_sort_by(self, compare);
    }
    fn par_sort_unstable_by<F: Fn(&T, &T) -> Ordering + Sync>(&mut self, compare: F)
    where
        T: Send,
    {
        ParallelSliceMut::par_sort_unstable_by(self, compare);
    }
    fn par_sort_unstable_by_key<K: Ord, F: Fn(&T) -> K + Sync>(&mut self, key: F)
    where
        T: Send,
    {
        ParallelSliceMut::par_sort_unstable_by_key(self, key);
    }
}

/// Loops over what it is made of.
pub trait IntoParallel {
    /// Where the items come from.
    type Source: Source;
    /// Over each item.
    fn into_par_iter(self) -> Loop<Self::Source>;
}

impl<S: Source> IntoParallel for Loop<S> {
    type Source = S;
    fn into_par_iter(self) -> Loop<S> {
        self
    }
}

impl<'a, T: Sync> IntoParallel for &'a [T] {
    type Source = Slice<'a, T>;
    fn into_par_iter(self) -> Loop<Self::Source> {
        self.par_iter()
    }
}

impl<'a, T: Sync> IntoParallel for &'a Vec<T> {
    type Source = Slice<'a, T>;
    fn into_par_iter(self) -> Loop<Self::Source> {
        self.par_iter()
    }
}

/// Each item costs a lock.
impl<T: Send> IntoParallel for Vec<T> {
    type Source = Owned<T>;
    fn into_par_iter(self) -> Loop<Self::Source> {
        Loop { source: self.into_iter().collect(), least: 1 }
    }
}

/// Writes [`IntoParallel`] for ranges of a type of whole numbers.
macro_rules! ranges {
    ($($n:ty),*) => { $(
        impl IntoParallel for Range<$n> {
            type Source = Numbers<$n>;
            fn into_par_iter(self) -> Loop<Self::Source> {
                let len = self.end.saturating_sub(self.start) as usize;
                Loop { source: Numbers { start: self.start, len }, least: 1 }
            }
        }
    )* };
}
ranges!(u32, u64, usize);

impl<S: Source> Loop<S> {
    /// At least `least` items for a part: where one costs less than a fraction of a microsecond.
    pub fn with_min_len(self, least: usize) -> Self {
        Loop { least, ..self }
    }
    /// A function of each item.
    pub fn map<U, F: Fn(S::Item) -> U + Sync>(self, function: F) -> Loop<Mapped<S, F>> {
        Loop { least: self.least, source: Mapped { source: self.source, function } }
    }
    /// Each item with its number.
    pub fn enumerate(self) -> Loop<Numbered<S>> {
        const { assert!(S::EXACT, "only exact loops have numbers") };
        Loop { least: self.least, source: Numbered(self.source) }
    }
    /// Pairs of items with the same number.
    pub fn zip<I: IntoParallel>(self, other: I) -> Loop<Zipped<S, I::Source>> {
        const { assert!(S::EXACT && I::Source::EXACT, "only exact loops have numbers") };
        Loop { least: self.least, source: Zipped(self.source, other.into_par_iter().source) }
    }
    /// Only what the condition lets through.
    pub fn filter<F: Fn(&S::Item) -> bool + Sync>(self, condition: F) -> Loop<Filtered<S, F>> {
        Loop { least: self.least, source: Filtered { source: self.source, condition } }
    }
    /// The results of a function for each item, one after another.
    pub fn flat_map_iter<I: IntoIterator, F: Fn(S::Item) -> I + Sync>(
        self,
        function: F,
    ) -> Loop<Flattened<S, F>> {
        Loop { least: self.least, source: Flattened { source: self.source, function } }
    }
    /// The results of a function for an item, where there is one.
    pub fn filter_map<U, F: Fn(S::Item) -> Option<U> + Sync>(self, function: F) -> Loop<Flattened<S, F>> {
        self.flat_map_iter(function)
    }
    /// A function of each item and of something that one thread uses again and again, made by `new` for each part.
    pub fn map_init<W, U, N, F>(self, new: N, function: F) -> Scratched<S, N, F>
    where
        N: Fn() -> W + Sync,
        F: Fn(&mut W, S::Item) -> U + Sync,
    {
        Scratched { inner: self, new, function }
    }

    /// Calls `function` with each item.
    pub fn for_each<F: Fn(S::Item) + Sync>(self, function: F) {
        let (len, source) = (self.source.len(), &self.source);
        let parts = count_parts(len, self.least);
        each_part(parts, &|part| source.items(range(part, parts, len)).for_each(&function));
    }
    /// Calls `function` with each item; the first error in the order of the items, and what lies behind it may not be done.
    ///
    /// # Errors
    /// The results of `function`.
    pub fn try_for_each<E: Send, F: Fn(S::Item) -> Result<(), E> + Sync>(self, function: F) -> Result<(), E> {
        self.map(function).collect::<Result<Vec<()>, E>>().map(drop)
    }
    /// The same with something that one thread uses again and again, made by `new` for each part.
    ///
    /// # Errors
    /// The results of `function`.
    pub fn try_for_each_init<W, E, N, F>(self, new: N, function: F) -> Result<(), E>
    where
        E: Send,
        N: Fn() -> W + Sync,
        F: Fn(&mut W, S::Item) -> Result<(), E> + Sync,
    {
        let source = &self.source;
        let failed = AtomicUsize::new(usize::MAX);
        let of = |part, range| {
            if failed.load(Relaxed) < part {
                return Ok(());
            }
            let mut work = new();
            let done = source.items(range).try_for_each(|item| function(&mut work, item));
            if done.is_err() {
                failed.fetch_min(part, Relaxed);
            }
            done
        };
        parts(source.len(), self.least, &of).into_iter().collect()
    }
    /// All items in order.
    pub fn collect<C: FromParts<S::Item>>(self) -> C {
        C::of(&self.source, self.least)
    }
    /// Both halves of the items, in order.
    pub fn unzip<A: Send, B: Send>(self) -> (Vec<A>, Vec<B>)
    where
        S: Source<Item = (A, B)>,
    {
        self.collect()
    }
    /// All items in order, into a vector that exists; what it held is gone.
    pub fn collect_into_vec(self, all: &mut Vec<S::Item>)
    where
        S::Item: Send,
    {
        const { assert!(S::EXACT, "only exact loops have numbers") };
        in_place(&self.source, self.least, all);
    }
    /// The results of each part for its items in turn, beginning with the value of `new`.
    pub fn fold<A, N, F>(self, new: N, function: F) -> Folded<S, N, F>
    where
        N: Fn() -> A + Sync,
        F: Fn(A, S::Item) -> A + Sync,
    {
        Folded { inner: self, new, function }
    }
    /// All items joined; what `new` gives changes nothing.
    pub fn reduce<N, J>(self, new: N, join: J) -> S::Item
    where
        S::Item: Send,
        N: Fn() -> S::Item + Sync,
        J: Fn(S::Item, S::Item) -> S::Item + Sync,
    {
        let source = &self.source;
        let of = |_, range| source.items(range).fold(new(), &join);
        parts(source.len(), self.least, &of).into_iter().fold(new(), &join)
    }
    /// How many items there are.
    pub fn count(self) -> usize {
        let source = &self.source;
        parts(source.len(), self.least, &|_, range| source.items(range).count()).into_iter().sum()
    }
    /// The sum, of whole numbers.
    pub fn sum<N: Send + std::iter::Sum<S::Item> + std::iter::Sum<N>>(self) -> N {
        let source = &self.source;
        parts(source.len(), self.least, &|_, range| source.items(range).sum::<N>()).into_iter().sum()
    }
    /// The greatest item, of equal ones the last.
    pub fn max_by<F>(self, compare: F) -> Option<S::Item>
    where
        S::Item: Send,
        F: Fn(&S::Item, &S::Item) -> Ordering + Sync,
    {
        let source = &self.source;
        let of = |_, range| source.items(range).max_by(&compare);
        parts(source.len(), self.least, &of).into_iter().flatten().max_by(&compare)
    }
    /// The greatest item.
    pub fn max(self) -> Option<S::Item>
    where
        S::Item: Send + Ord,
    {
        self.max_by(Ord::cmp)
    }
    /// The least item.
    pub fn min(self) -> Option<S::Item>
    where
        S::Item: Send + Ord,
    {
        let source = &self.source;
        parts(source.len(), self.least, &|_, range| source.items(range).min()).into_iter().flatten().min()
    }
    /// The first result of `function`, in the order of the items.
    pub fn find_map_first<U: Send, F: Fn(S::Item) -> Option<U> + Sync>(self, function: F) -> Option<U> {
        let source = &self.source;
        let found = AtomicUsize::new(usize::MAX);
        let of = |part, range| {
            if found.load(Relaxed) < part {
                return None;
            }
            let first = source.items(range).find_map(&function);
            if first.is_some() {
                found.fetch_min(part, Relaxed);
            }
            first
        };
        parts(source.len(), self.least, &of).into_iter().flatten().next()
    }
    /// Number of the first item that meets the condition.
    pub fn position_first<F: Fn(S::Item) -> bool + Sync>(self, condition: F) -> Option<usize> {
        self.enumerate().find_map_first(|(i, item)| condition(item).then_some(i))
    }
    /// Whether all items meet the condition.
    pub fn all<F: Fn(S::Item) -> bool + Sync>(self, condition: F) -> bool {
        self.find_map_first(|item| (!condition(item)).then_some(())).is_none()
    }
    /// Whether an item meets the condition.
    pub fn any<F: Fn(S::Item) -> bool + Sync>(self, condition: F) -> bool {
        self.find_map_first(|item| condition(item).then_some(())).is_some()
    }
}

impl<'a, T: Copy + 'a, S: Source<Item = &'a T>> Loop<S> {
    /// Copies of the items.
    pub fn copied(self) -> Loop<Copies<S>> {
        Loop { least: self.least, source: Copies(self.source) }
    }
}

/// A loop whose parts each have something to work with.
#[derive(Debug)]
#[must_use = "a loop does nothing until its items are asked for"]
pub struct Scratched<S, N, F> {
    inner: Loop<S>,
    new: N,
    function: F,
}

impl<S: Source, N, F> Scratched<S, N, F> {
    /// The results in order.
    pub fn collect<W, U: Send>(self) -> Vec<U>
    where
        N: Fn() -> W + Sync,
        F: Fn(&mut W, S::Item) -> U + Sync,
    {
        let Scratched { inner: Loop { source, least }, new, function } = self;
        let of = |_, range| {
            let mut work = new();
            source.items(range).map(|item| function(&mut work, item)).collect::<Vec<U>>()
        };
        parts(source.len(), least, &of).into_iter().flatten().collect()
    }
}

/// A loop whose parts each have made one thing of their items.
#[derive(Debug)]
#[must_use = "a loop does nothing until its items are asked for"]
pub struct Folded<S, N, F> {
    inner: Loop<S>,
    new: N,
    function: F,
}

impl<S: Source, N, F> Folded<S, N, F> {
    /// The results of the parts, joined in order; the value of `new` changes nothing.
    pub fn reduce<A: Send>(self, new: impl Fn() -> A, join: impl Fn(A, A) -> A) -> A
    where
        N: Fn() -> A + Sync,
        F: Fn(A, S::Item) -> A + Sync,
    {
        let Folded { inner: Loop { source, least }, new: first, function } = self;
        let of = |_, range| source.items(range).fold(first(), &function);
        parts(source.len(), least, &of).into_iter().fold(new(), join)
    }
}
