//! Every loop beside the same loop on one thread, for lengths around the number of parts, on pools of several sizes.

use super::prelude::*;
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

const LENGTHS: [usize; 9] = [0, 1, 2, 15, 16, 17, 47, 1000, 4099];

fn on_pools(check: impl Fn(&[u32]) + Sync) {
    for threads in [1, 2, 3, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        for n in LENGTHS {
            let items: Vec<u32> = (0..n as u32).map(|i| i.wrapping_mul(2_654_435_761) >> 7).collect();
            pool.install(|| check(&items));
        }
    }
}

#[test]
fn items_are_collected_in_order() {
    on_pools(|items| {
        let want: Vec<u64> = items.iter().map(|x| u64::from(*x) + 1).collect();
        assert_eq!(items.par_iter().map(|x| u64::from(*x) + 1).collect::<Vec<u64>>(), want);
        assert_eq!(items.par_iter().with_min_len(10).map(|x| u64::from(*x) + 1).collect::<Vec<u64>>(), want);
        let mut filled = vec![7; 3];
        items.par_iter().map(|x| u64::from(*x) + 1).collect_into_vec(&mut filled);
        assert_eq!(filled, want);
        assert_eq!(items.to_vec().into_par_iter().map(|x| u64::from(x) + 1).collect::<Vec<u64>>(), want);
        let numbers: Vec<(usize, (u32, usize))> =
            items.par_iter().copied().zip(5..usize::MAX).enumerate().collect();
        let want: Vec<(usize, (u32, usize))> = items.iter().copied().zip(5..).enumerate().collect();
        assert_eq!(numbers, want);
        let odd = |x: &&u32| x.is_multiple_of(3);
        let want: Vec<&u32> = items.iter().filter(odd).collect();
        assert_eq!(items.par_iter().filter(odd).collect::<Vec<&u32>>(), want);
        let several = |x: &u32| (0..*x % 4).map(u64::from).collect::<Vec<u64>>();
        let want: Vec<u64> = items.iter().flat_map(several).collect();
        assert_eq!(items.par_iter().flat_map_iter(several).collect::<Vec<u64>>(), want);
        let halves: (Vec<u32>, Vec<String>) = items.par_iter().map(|x| (*x, x.to_string())).unzip();
        assert_eq!(halves, items.iter().map(|x| (*x, x.to_string())).unzip());
        let counted = items.par_iter().map_init(Vec::new, |seen, x| {
            seen.push(*x);
            (seen.last() == Some(x)).then_some(*x)
        });
        assert_eq!(counted.collect(), items.iter().map(|x| Some(*x)).collect::<Vec<_>>());
        let pieces: Vec<usize> = items.par_chunks(10).map(<[u32]>::len).collect();
        assert_eq!(pieces, items.chunks(10).map(<[u32]>::len).collect::<Vec<_>>());
    });
}

#[test]
fn every_item_is_taken_once() {
    on_pools(|items| {
        let times: Vec<AtomicUsize> = items.iter().map(|_| AtomicUsize::new(0)).collect();
        (0..items.len()).into_par_iter().for_each(|i| {
            times[i].fetch_add(1, Relaxed);
        });
        assert!(times.iter().all(|t| t.load(Relaxed) == 1));
        let mut more = items.to_vec();
        more.par_iter_mut().for_each(|x| *x += 1);
        more.par_chunks_mut(7).for_each(|part| part.iter_mut().for_each(|x| *x += 1));
        assert!(more.iter().zip(items).all(|(a, b)| *a == b + 2));
        let seen = Mutex::new(BTreeSet::new());
        let all = items.par_iter().enumerate().try_for_each_init(
            || (),
            |(), (i, _)| if seen.lock().unwrap().insert(i) { Ok(()) } else { Err(i) },
        );
        assert_eq!((all, seen.into_inner().unwrap().len()), (Ok(()), items.len()));
    });
}

#[test]
fn what_is_made_of_all_is_that_of_one_thread() {
    on_pools(|items| {
        let sum = |x: &[u32]| x.iter().map(|x| u64::from(*x)).sum::<u64>();
        assert_eq!(items.par_iter().map(|x| u64::from(*x)).sum::<u64>(), sum(items));
        assert_eq!(items.par_iter().map(|x| u64::from(*x)).reduce(|| 0, |a, b| a + b), sum(items));
        assert_eq!(
            items.par_iter().fold(|| 0, |a, x| a + u64::from(*x)).reduce(|| 0, |a, b| a + b),
            sum(items)
        );
        // Joined in order.
        let text = items.par_iter().map(u32::to_string).reduce(String::new, |a, b| a + &b);
        assert_eq!(text, items.iter().map(u32::to_string).collect::<String>());
        assert_eq!(
            (items.par_iter().min(), items.par_iter().max()),
            (items.iter().min(), items.iter().max())
        );
        assert_eq!(
            items.par_iter().max_by(|a, b| (**a % 8).cmp(&(**b % 8))),
            items.iter().max_by_key(|x| **x % 8)
        );
        assert_eq!(
            items.par_iter().filter(|x| x.is_multiple_of(2)).count(),
            items.iter().filter(|x| x.is_multiple_of(2)).count()
        );
    });
}

#[test]
fn the_first_match_and_the_first_error_are_found() {
    on_pools(|items| {
        let hit = |x: &u32| *x % 5 == 4;
        assert_eq!(items.par_iter().position_first(hit), items.iter().position(hit));
        assert_eq!(items.par_iter().any(hit), items.iter().any(hit));
        assert_eq!(items.par_iter().all(|x| !hit(x)), items.iter().all(|x| !hit(x)));
        let tried = |x: &u32| if hit(x) { Err(*x) } else { Ok(*x) };
        let want: Result<Vec<u32>, u32> = items.iter().map(tried).collect();
        assert_eq!(items.par_iter().map(tried).collect::<Result<Vec<u32>, u32>>(), want);
        assert_eq!(
            items.par_iter().try_for_each(|x| tried(x).map(drop)),
            want.as_ref().map(|_| ()).map_err(|e| *e)
        );
        let option: Option<Vec<u32>> = items.par_iter().map(|x| tried(x).ok()).collect();
        assert_eq!(option, want.ok());
    });
}

#[test]
fn loops_within_loops_end() {
    let sum: u64 =
        (0..50u64).into_par_iter().map(|i| (0..i).into_par_iter().map(|j| j * i).sum::<u64>()).sum();
    assert_eq!(sum, (0..50u64).map(|i| (0..i).map(|j| j * i).sum::<u64>()).sum::<u64>());
}
