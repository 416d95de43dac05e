//! A container that the items of a loop are put into.
#![expect(unsafe_code, reason = "results are written where they stay, without a copy of all of them")]

use super::source::Source;
use super::split::{count_parts, each_part, range};
use std::mem::MaybeUninit;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

/// Made of the items of a loop.
pub trait FromParts<T>: Sized {
    /// All items in order; a part has `least` of them or more.
    fn of<S: Source<Item = T>>(source: &S, least: usize) -> Self;
}

impl<T: Send> FromParts<T> for Vec<T> {
    fn of<S: Source<Item = T>>(source: &S, least: usize) -> Self {
        if S::EXACT {
            let mut all = Vec::new();
            in_place(source, least, &mut all);
            return all;
        }
        concatenated(parts(source.len(), least, &|_, range| source.items(range).collect()))
    }
}

/// The first error in the order of the items. Parts behind it are not begun any more.
impl<T: Send, E: Send> FromParts<Result<T, E>> for Result<Vec<T>, E> {
    fn of<S: Source<Item = Result<T, E>>>(source: &S, least: usize) -> Self {
        let failed = AtomicUsize::new(usize::MAX);
        let parts: Vec<Result<Vec<T>, E>> = parts(source.len(), least, &|part, range| {
            if failed.load(Relaxed) < part {
                return Ok(vec![]);
            }
            let done: Result<Vec<T>, E> = source.items(range).collect();
            if done.is_err() {
                failed.fetch_min(part, Relaxed);
            }
            done
        });
        Ok(concatenated(parts.into_iter().collect::<Result<_, E>>()?))
    }
}

/// `None` where an item is.
impl<T: Send> FromParts<Option<T>> for Option<Vec<T>> {
    fn of<S: Source<Item = Option<T>>>(source: &S, least: usize) -> Self {
        let parts: Vec<Option<Vec<T>>> =
            parts(source.len(), least, &|_, range| source.items(range).collect());
        Some(concatenated(parts.into_iter().collect::<Option<_>>()?))
    }
}

/// Two lists of the halves of pairs.
impl<A: Send, B: Send> FromParts<(A, B)> for (Vec<A>, Vec<B>) {
    fn of<S: Source<Item = (A, B)>>(source: &S, least: usize) -> Self {
        let parts: Vec<(Vec<A>, Vec<B>)> =
            parts(source.len(), least, &|_, range| source.items(range).unzip());
        let (first, second) = parts.into_iter().unzip();
        (concatenated(first), concatenated(second))
    }
}

/// The results of `of` for each part of `len` items, in order. `of` is given the number of the part and of its items.
pub(super) fn parts<T: Send>(
    len: usize,
    least: usize,
    of: &(dyn Fn(usize, Range<usize>) -> T + Sync),
) -> Vec<T> {
    let parts = count_parts(len, least);
    if parts == 1 {
        return vec![of(0, 0..len)];
    }
    let made: Vec<Mutex<Option<T>>> = (0..parts).map(|_| Mutex::new(None)).collect();
    each_part(parts, &|part| {
        let value = of(part, range(part, parts, len));
        *made[part].lock().unwrap_or_else(PoisonError::into_inner) = Some(value);
    });
    made.into_iter().filter_map(|value| value.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}

fn concatenated<T>(mut parts: Vec<Vec<T>>) -> Vec<T> {
    if parts.len() == 1 {
        return parts.remove(0);
    }
    let mut all = Vec::with_capacity(parts.iter().map(Vec::len).sum());
    parts.into_iter().for_each(|mut part| all.append(&mut part));
    all
}

/// Fills `all`, which is emptied first, with the items of an exact source, each written once and where it stays.
pub(super) fn in_place<S: Source>(source: &S, least: usize, all: &mut Vec<S::Item>)
where
    S::Item: Send,
{
    let len = source.len();
    let parts = count_parts(len, least);
    all.clear();
    if parts <= 1 {
        all.extend(source.items(0..len));
        return;
    }
    all.reserve_exact(len);
    let mut rest = &mut all.spare_capacity_mut()[..len];
    let mut places: Vec<Mutex<&mut [MaybeUninit<S::Item>]>> = Vec::with_capacity(parts);
    for part in 0..parts {
        let (place, others) = rest.split_at_mut(range(part, parts, len).len());
        places.push(Mutex::new(place));
        rest = others;
    }
    let written = AtomicUsize::new(0);
    each_part(parts, &|part| {
        let mut place = places[part].lock().unwrap_or_else(PoisonError::into_inner);
        let mut count = 0;
        for (slot, item) in place.iter_mut().zip(source.items(range(part, parts, len))) {
            slot.write(item);
            count += 1;
        }
        written.fetch_add(count, Relaxed);
    });
    // A source that is not exact after all loses its items, and nothing that was not written is read.
    if written.into_inner() == len {
        // SAFETY: the parts are all of 0..len, each was done once, and every one of their slots was written.
        unsafe { all.set_len(len) };
    }
}
