//! Where the items of a loop come from: anything of which a thread can take a range.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Items numbered from 0.
pub trait Source: Sync {
    /// The type of one of them.
    type Item;
    /// Whether [`Source::items`] gives as many items as its range has numbers. Else as many or fewer, or several for one.
    const EXACT: bool;
    /// How many numbers there are.
    fn len(&self) -> usize;
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The items of a range, in order. Asked once at most for each number.
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = Self::Item>;
}

/// References into a slice.
#[derive(Debug)]
pub struct Slice<'a, T>(pub(super) &'a [T]);

impl<'a, T: Sync> Source for Slice<'a, T> {
    type Item = &'a T;
    const EXACT: bool = true;
    fn len(&self) -> usize {
        self.0.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = &'a T> {
        self.0[range].iter()
    }
}

/// Pieces of a slice, all of one size but the last.
#[derive(Debug)]
pub struct Chunks<'a, T> {
    pub(super) slice: &'a [T],
    pub(super) size: usize,
}

impl<'a, T: Sync> Source for Chunks<'a, T> {
    type Item = &'a [T];
    const EXACT: bool = true;
    fn len(&self) -> usize {
        self.slice.len().div_ceil(self.size)
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = &'a [T]> {
        let end = self.slice.len().min(range.end * self.size);
        self.slice[range.start * self.size..end].chunks(self.size)
    }
}

/// Whole numbers from a first one on.
#[derive(Debug)]
pub struct Numbers<N> {
    pub(super) start: N,
    pub(super) len: usize,
}

/// Writes [`Source`] for ranges of a type of whole numbers.
macro_rules! numbers {
    ($($n:ty),*) => { $(
        impl Source for Numbers<$n> {
            type Item = $n;
            const EXACT: bool = true;
            fn len(&self) -> usize {
                self.len
            }
            fn items(&self, range: Range<usize>) -> impl Iterator<Item = $n> {
                self.start + range.start as $n..self.start + range.end as $n
            }
        }
    )* };
}
numbers!(u32, u64, usize);

/// Values that each are given away once: those of a vector, or exclusive references.
#[derive(Debug)]
pub struct Owned<T>(Vec<Mutex<Option<T>>>);

impl<T> FromIterator<T> for Owned<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        Owned(values.into_iter().map(|value| Mutex::new(Some(value))).collect())
    }
}

impl<T: Send> Source for Owned<T> {
    type Item = T;
    const EXACT: bool = true;
    fn len(&self) -> usize {
        self.0.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = T> {
        self.0[range].iter().filter_map(|value| value.lock().unwrap_or_else(PoisonError::into_inner).take())
    }
}

/// Copies of what references point to.
#[derive(Debug)]
pub struct Copies<S>(pub(super) S);

impl<'a, T: Copy + 'a, S: Source<Item = &'a T>> Source for Copies<S> {
    type Item = T;
    const EXACT: bool = S::EXACT;
    fn len(&self) -> usize {
        self.0.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = T> {
        self.0.items(range).copied()
    }
}

/// A function of each item.
#[derive(Debug)]
pub struct Mapped<S, F> {
    pub(super) source: S,
    pub(super) function: F,
}

impl<S: Source, U, F: Fn(S::Item) -> U + Sync> Source for Mapped<S, F> {
    type Item = U;
    const EXACT: bool = S::EXACT;
    fn len(&self) -> usize {
        self.source.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = U> {
        self.source.items(range).map(&self.function)
    }
}

/// Each item with its number.
#[derive(Debug)]
pub struct Numbered<S>(pub(super) S);

impl<S: Source> Source for Numbered<S> {
    type Item = (usize, S::Item);
    const EXACT: bool = S::EXACT;
    fn len(&self) -> usize {
        self.0.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = (usize, S::Item)> {
        range.clone().zip(self.0.items(range))
    }
}

/// The items of two sources with the same numbers.
#[derive(Debug)]
pub struct Zipped<A, B>(pub(super) A, pub(super) B);

impl<A: Source, B: Source> Source for Zipped<A, B> {
    type Item = (A::Item, B::Item);
    const EXACT: bool = A::EXACT && B::EXACT;
    fn len(&self) -> usize {
        self.0.len().min(self.1.len())
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = (A::Item, B::Item)> {
        self.0.items(range.clone()).zip(self.1.items(range))
    }
}

/// Items that a condition lets through.
#[derive(Debug)]
pub struct Filtered<S, F> {
    pub(super) source: S,
    pub(super) condition: F,
}

impl<S: Source, F: Fn(&S::Item) -> bool + Sync> Source for Filtered<S, F> {
    type Item = S::Item;
    const EXACT: bool = false;
    fn len(&self) -> usize {
        self.source.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = S::Item> {
        self.source.items(range).filter(&self.condition)
    }
}

/// None, one or several items for each.
#[derive(Debug)]
pub struct Flattened<S, F> {
    pub(super) source: S,
    pub(super) function: F,
}

impl<S: Source, I: IntoIterator, F: Fn(S::Item) -> I + Sync> Source for Flattened<S, F> {
    type Item = I::Item;
    const EXACT: bool = false;
    fn len(&self) -> usize {
        self.source.len()
    }
    fn items(&self, range: Range<usize>) -> impl Iterator<Item = I::Item> {
        self.source.items(range).flat_map(&self.function)
    }
}
